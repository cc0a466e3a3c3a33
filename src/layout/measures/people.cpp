#include "layout/measures/people.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/units.h"
#include "layout/measures/quarter.h"

namespace tera {
namespace {

constexpr double kRangeStep_m = 1.0;
constexpr double kNear_m = 12.0;
constexpr double kSector_rad = 2 * kPi / PersonRange::kSectors;

/// Results at each distance in one or more directions.
struct Tried {
  std::vector<bool> place, missed;

  explicit Tried(std::size_t steps) : place(steps), missed(steps) {}
  void Add(int step, bool detected) {
    place[static_cast<std::size_t>(step)] = true;
    if (!detected) missed[static_cast<std::size_t>(step)] = true;
  }
  std::vector<bool> Detected() const {
    std::vector<bool> detected;
    for (std::size_t s = 0; s < place.size(); ++s) detected.push_back(place[s] && !missed[s]);
    return detected;
  }
};

}  // namespace

PersonRange::PersonRange(Posture posture, const PersonStudy& study, double reflectance)
    : posture_(std::move(posture)),
      study_(study),
      reflectance_(reflectance),
      patches_(PatchesOf(posture_)),
      quarters_(kQuarters.size()),
      had_place_(static_cast<std::size_t>(kSectors) * Distances_m().size()),
      had_enough_(had_place_),
      probability_(posture_.name, study_.cluster_points, static_cast<int>(Distances_m().size())) {}

std::vector<double> PersonRange::Distances_m() const {
  std::vector<double> distances_m;
  for (double d_m = kRangeStep_m; d_m <= study_.farthest_m; d_m += kRangeStep_m)
    distances_m.push_back(d_m);
  return distances_m;
}

PersonRange::Had PersonRange::HadOf(const std::vector<PersonPlace>& places, const Layout& layout,
                                    const Sighting& sighting) const {
  std::vector<Pose> X_WP;
  for (const PersonPlace& place : places) X_WP.push_back(place.X_WP);
  Had had{std::vector<bool>(places.size(), false), std::vector<double>(places.size(), 0)};
  for (const Viewer& viewer : layout.viewers) {
    const std::vector<double> count =
        SamplesOnPersons(patches_, X_WP, viewer, reflectance_, sighting);
    const bool is_lidar = viewer.field.samples == ViewField::Samples::kPoints;
    const double needed = is_lidar ? study_.lidar_points : study_.camera_px;
    for (std::size_t p = 0; p < places.size(); ++p) {
      had.enough[p] = had.enough[p] || count[p] >= needed;
      if (is_lidar) had.points[p] += kBodyOfBox * count[p];
    }
  }
  return had;
}

void PersonRange::Add(const Pose& X_WH, const std::vector<double>& hull_m, const Layout& layout,
                      const Sighting& sighting, const TerrainSurface& ground) {
  const std::vector<PersonPlace> places =
      PlacesAroundHull(X_WH, hull_m, Distances_m(), sighting, ground);
  const Had had = HadOf(places, layout, sighting);
  AddReach(places, had.enough);
  probability_.Add(places, had.points);
}

PersonRange::Reach PersonRange::ReachOf(const std::vector<bool>& detected) const {
  const std::vector<double> distances_m = Distances_m();
  Reach reach{.from_m = distances_m.back() + kRangeStep_m};
  for (std::size_t s = 0; s < detected.size(); ++s) {
    if (!detected[s]) continue;
    reach.from_m = std::min(reach.from_m, distances_m[s]);
    reach.to_m = distances_m[s];
    reach.over_m += kRangeStep_m;
  }
  return reach;
}

void PersonRange::AddReach(const std::vector<PersonPlace>& places,
                           const std::vector<bool>& detected) {
  const std::vector<double> distances_m = Distances_m();
  std::vector<Tried> directions(kSectors, Tried(distances_m.size()));
  std::vector<Tried> quarters(kQuarters.size(), Tried(distances_m.size()));
  std::size_t near = 0, near_detected = 0;
  for (std::size_t p = 0; p < places.size(); ++p) {
    const auto& [sector, step, X_WP] = places[p];
    directions[static_cast<std::size_t>(sector)].Add(step, detected[p]);
    for (std::size_t q = 0; q < kQuarters.size(); ++q) {
      if (kQuarters[q].Holds(sector * kSector_rad)) quarters[q].Add(step, detected[p]);
    }
    const auto at =
        static_cast<std::size_t>(sector) * distances_m.size() + static_cast<std::size_t>(step);
    had_place_[at] += 1;
    had_enough_[at] += detected[p];
    if (distances_m[static_cast<std::size_t>(step)] > kNear_m) continue;
    ++near;
    near_detected += detected[p];
  }
  for (std::size_t s = 0; s < directions.size(); ++s) {
    directions_[s].push_back(ReachOf(directions[s].Detected()));
  }
  for (std::size_t q = 0; q < quarters.size(); ++q) {
    quarters_[q].push_back(ReachOf(quarters[q].Detected()));
  }
  within_12m_.push_back(static_cast<double>(near_detected) / static_cast<double>(near));
  tried_.push_back(near);
}

std::vector<Figure> PersonRange::Figures() const {
  std::vector<Figure> figures;
  for (std::size_t q = 0; q < kQuarters.size(); ++q) {
    const auto figure = [&](Measure measure, double Reach::*number) {
      Figure f{{measure, posture_.name, q}, {}, {}};
      for (const Reach& reach : quarters_[q]) f.at.push_back(reach.*number);
      // Each end lies somewhere between two tested distances.
      f.error.assign(f.at.size(), EvenSigma(kRangeStep_m));
      figures.push_back(std::move(f));
    };
    figure(Measure::kDetectedFrom, &Reach::from_m);
    figure(Measure::kDetectedTo, &Reach::to_m);
    figure(Measure::kDetectedOver, &Reach::over_m);
  }
  Figure share{{Measure::kDetectedShare, posture_.name}, within_12m_, {}};
  for (std::size_t m = 0; m < within_12m_.size(); ++m) {
    share.error.push_back(ShareError(within_12m_[m], tried_[m]));
  }
  figures.push_back(std::move(share));
  for (Figure& figure : probability_.Figures()) figures.push_back(std::move(figure));
  return figures;
}

PolarCurve PersonRange::Curve() const {
  PolarCurve curve{
      .id = {Measure::kPersonCurve, posture_.name},
      .title = fmt::format("Detection range of a {} person, in m from the machine's outline",
                           posture_.name),
      .most = study_.farthest_m,
      .mean = {},
      .worst = {}};
  for (const std::vector<Reach>& at : directions_) {
    double sum_m = 0, from_m = 0, to_m = study_.farthest_m;
    for (const Reach& reach : at) {
      sum_m += reach.to_m;
      from_m = std::max(from_m, reach.from_m);
      to_m = std::min(to_m, reach.to_m);
    }
    const bool is_always = from_m <= to_m;
    curve.mean.push_back(sum_m / static_cast<double>(at.size()));
    curve.worst.push_back(is_always ? to_m : 0);
    curve.worst_from.push_back(is_always ? from_m : 0);
  }
  return curve;
}

PolarMap PersonRange::DetectedMap() const {
  PolarMap map{
      .id = {Measure::kDetectedMap, posture_.name},
      .title = fmt::format("Share of the cycle in which a {} person is detected; rings are "
                           "metres from the machine's outline",
                           posture_.name),
      .sectors = kSectors,
      .rings = static_cast<int>(Distances_m().size()),
      .ring_m = kRangeStep_m};
  for (std::size_t p = 0; p < had_place_.size(); ++p) {
    map.value.push_back(had_place_[p] > 0 ? had_enough_[p] / had_place_[p] : -1);
  }
  return map;
}

std::vector<PolarMap> PersonRange::Maps() const {
  std::vector<PolarMap> maps = {DetectedMap()};
  for (PolarMap& map : probability_.Maps()) maps.push_back(std::move(map));
  return maps;
}

}  // namespace tera
