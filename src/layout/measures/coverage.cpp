#include "layout/measures/coverage.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "layout/measures/polar_grid.h"

namespace tera {
namespace {

constexpr char kOutOfView[] = "out of view", kTooFar[] = "too far or too sparse";

}  // namespace

ZoneCoverage::ZoneCoverage(Zone zone, int count, std::uint64_t seed)
    : zone_(std::move(zone)), places_Z_m_(PointsIn(zone_, count, seed)), share_(kMost) {}

std::vector<Vec3> ZoneCoverage::PlacesInAir(const Pose& X_WF, const Sighting& sighting,
                                            const TerrainSurface& ground) const {
  const Pose X_WZ = X_WF * zone_.X_FZ;
  std::vector<Vec3> above_W_m;
  for (const Vec3& p_Z_m : places_Z_m_) {
    const Vec3 p_W_m = X_WZ * p_Z_m;
    if (!IsOnSite(ground, p_W_m)) continue;
    if (p_W_m.z() > ground.HeightAt(p_W_m.x(), p_W_m.y())) above_W_m.push_back(p_W_m);
  }
  const std::vector<bool> inside = sighting.AreInside(above_W_m);
  std::vector<Vec3> in_air_W_m;
  for (std::size_t p = 0; p < above_W_m.size(); ++p) {
    if (!inside[p]) in_air_W_m.push_back(above_W_m[p]);
  }
  return in_air_W_m;
}

void ZoneCoverage::Add(const std::vector<Vec3>& in_air_W_m, const Layout& layout,
                       const SeenFrom& seen, const Sighting& sighting) {
  std::vector<double> count(kMost, 0);
  for (const Viewer& viewer : layout.viewers) fields_.try_emplace(viewer.name);
  for (const std::vector<Look>& looks : LookAt(in_air_W_m, layout, seen, sighting)) {
    const int by = SeenBy(looks);
    for (int n = 0; n < kMost; ++n) count[n] += by > n;
    if (by == 0) CountCauses(looks, sighting);
    CountPairs(looks, layout);
    CountFields(looks, layout, sighting);
  }
  const auto n = static_cast<double>(in_air_W_m.size());
  for (int k = 0; k < kMost; ++k) share_[k].push_back(n > 0 ? count[k] / n : 1);
  in_air_.push_back(in_air_W_m.size());
  const double air_m3 = Volume_m3(zone_) * n / static_cast<double>(places_Z_m_.size());
  blind_m3_.push_back(air_m3 * (1 - share_[0].back()));
}

/// Adds a blind place to the causes. The viewers that have it in view contribute equal shares, each
/// to its own cause: the occluder, or "too far or too sparse". If no viewer has it in view, the
/// cause is "out of view".
void ZoneCoverage::CountCauses(const std::vector<Look>& looks, const Sighting& sighting) {
  std::vector<std::string> causes;
  for (const Look& look : looks) {
    if (look.why == Unseen::kBlocked) causes.push_back(sighting.NameOf(look.by));
    if (look.why == Unseen::kTooFarOrSparse) causes.push_back(kTooFar);
  }
  if (causes.empty()) causes.push_back(kOutOfView);
  for (const std::string& cause : causes) {
    causes_[cause] += 1.0 / static_cast<double>(causes.size());
  }
}

void ZoneCoverage::CountFields(const std::vector<Look>& looks, const Layout& layout,
                               const Sighting& sighting) {
  for (std::size_t v = 0; v < looks.size(); ++v) {
    const Look& look = looks[v];
    FieldOf& field = fields_[layout.viewers[v].name];
    if (look.sees) {
      field.seen += 1;
    } else if (look.why == Unseen::kBlocked) {
      field.hidden += 1;
      field.hidden_by[sighting.NameOf(look.by)] += 1;
    }
  }
}

void ZoneCoverage::CountPairs(const std::vector<Look>& looks, const Layout& layout) {
  for (std::size_t a = 0; a < looks.size(); ++a) {
    for (std::size_t b = a + 1; b < looks.size(); ++b) {
      if (!looks[a].sees && !looks[b].sees) continue;
      Pair& pair = pairs_[layout.viewers[a].name + " and " + layout.viewers[b].name];
      pair.either += 1;
      pair.both += looks[a].sees && looks[b].sees;
    }
  }
}

bool ZoneCoverage::HadPlaces() const {
  return std::any_of(in_air_.begin(), in_air_.end(), [](std::size_t places) { return places > 0; });
}

std::vector<Figure> ZoneCoverage::Figures() const {
  std::vector<Figure> figures;
  constexpr std::array<Measure, kMost> kSeenBy = {Measure::kSeenBy1, Measure::kSeenBy2,
                                                  Measure::kSeenBy3};
  for (int n = 0; n < kMost; ++n) {
    Figure figure{{kSeenBy[n], zone_.name}, share_[n], {}};
    for (std::size_t m = 0; m < in_air_.size(); ++m) {
      figure.error.push_back(ShareError(share_[n][m], in_air_[m]));
    }
    figures.push_back(std::move(figure));
  }
  Figure blind{{Measure::kBlindVolume, zone_.name}, blind_m3_, {}};
  for (std::size_t m = 0; m < in_air_.size(); ++m) {
    const double in_air = static_cast<double>(in_air_[m]);
    const double air_m3 = Volume_m3(zone_) * in_air / static_cast<double>(places_Z_m_.size());
    blind.error.push_back(air_m3 * ShareError(share_[0][m], in_air_[m]));
  }
  figures.push_back(std::move(blind));
  return figures;
}

std::map<std::string, double> ZoneCoverage::Causes() const {
  double sum = 0;
  for (const auto& [name, count] : causes_) sum += count;
  std::map<std::string, double> shares;
  for (const auto& [name, count] : causes_) shares[name] = count / sum;
  return shares;
}

std::map<std::string, double> ZoneCoverage::Overlaps() const {
  std::map<std::string, double> overlaps;
  for (const auto& [name, pair] : pairs_) overlaps[name] = pair.both / pair.either;
  return overlaps;
}

}  // namespace tera
