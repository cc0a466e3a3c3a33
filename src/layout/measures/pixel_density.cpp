#include "layout/measures/pixel_density.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "layout/measures/quarter.h"
#include "layout/sight/look.h"

namespace tera {
namespace {

constexpr std::size_t kPurposeCount = PixelDensity::kPurposes.size();

/// Pixels per metre of the camera with the highest density at each counted place, on a surface that
/// faces it. 0 if no camera sees the place.
std::vector<double> DensitiesAt(const PolarPlaces& places, const Layout& layout,
                                const Sighting& sighting) {
  std::vector<Target> targets;
  std::vector<std::size_t> place;
  for (std::size_t p = 0; p < places.p_W_m.size(); ++p) {
    if (!places.count[p]) continue;
    targets.push_back({places.p_W_m[p]});
    place.push_back(p);
  }
  std::vector<double> best_px_per_m(places.p_W_m.size(), 0);
  for (const Viewer& viewer : layout.viewers) {
    if (viewer.field.samples != ViewField::Samples::kPixels) continue;
    const std::vector<Look> looks = LookFrom(viewer, targets, {}, sighting);
    for (std::size_t i = 0; i < looks.size(); ++i) {
      double& best = best_px_per_m[place[i]];
      if (looks[i].sees) best = std::max(best, std::sqrt(looks[i].per_m2));
    }
  }
  return best_px_per_m;
}

}  // namespace

PixelDensity::PixelDensity()
    : farthest_m_(kPurposeCount, OfSectors(PolarGrid::kSectors)),
      share_(kPurposeCount),
      sum_px_per_m_(static_cast<std::size_t>(PolarGrid::kSectors) * PolarGrid::kRings, 0),
      counted_(sum_px_per_m_) {}

void PixelDensity::Add(const PolarPlaces& places, const Layout& layout, const Sighting& sighting) {
  const std::vector<double> px_per_m = DensitiesAt(places, layout, sighting);
  for (std::size_t p = 0; p < px_per_m.size(); ++p) {
    counted_[p] += places.count[p];
    sum_px_per_m_[p] += px_per_m[p];
  }
  std::vector<double> near_m2;
  for (std::size_t p = 0; p < px_per_m.size(); ++p) {
    const int ring = static_cast<int>(p % PolarGrid::kRings);
    if (places.count[p] && ring < PolarGrid::kNearRings)
      near_m2.push_back(PolarGrid::Area_m2(ring));
  }
  near_places_.push_back(LikeCount(near_m2));
  const double all_m2 = std::accumulate(near_m2.begin(), near_m2.end(), 0.0);
  for (std::size_t purpose = 0; purpose < kPurposeCount; ++purpose) {
    double held_m2 = 0;
    for (int sector = 0; sector < PolarGrid::kSectors; ++sector) {
      double farthest_m = 0;
      for (int ring = 0; ring < PolarGrid::kRings; ++ring) {
        const std::size_t p = PolarGrid::Index(sector, ring);
        const bool holds = px_per_m[p] >= kPurposes[purpose].px_per_m;
        if (holds) farthest_m = PolarGrid::Radius_m(ring);
        if (holds && ring < PolarGrid::kNearRings) held_m2 += PolarGrid::Area_m2(ring);
      }
      farthest_m_[purpose][sector].push_back(farthest_m);
    }
    share_[purpose].push_back(all_m2 > 0 ? held_m2 / all_m2 : 0);
  }
}

std::vector<Figure> PixelDensity::Figures() const {
  std::vector<Figure> figures;
  for (std::size_t purpose = 0; purpose < kPurposeCount; ++purpose) {
    const std::string name = kPurposes[purpose].name;
    Figure share{{Measure::kPixelShare, name}, share_[purpose]};
    for (std::size_t m = 0; m < near_places_.size(); ++m) {
      share.error.push_back(ShareError(share.at[m], near_places_[m]));
    }
    figures.push_back(std::move(share));
    for (std::size_t q = 0; q < kQuarters.size(); ++q) {
      Figure figure{{Measure::kPixelReach, name, q}};
      for (std::size_t m = 0; m < share_[purpose].size(); ++m) {
        double sum_m = 0, directions = 0;
        for (int sector = 0; sector < PolarGrid::kSectors; ++sector) {
          if (!kQuarters[q].Holds(PolarGrid::Azimuth_rad(sector))) continue;
          sum_m += farthest_m_[purpose][sector][m];
          directions += 1;
        }
        figure.at.push_back(sum_m / directions);
        // Each distance is uniform within a ring.
        figure.error.push_back(EvenSigma(PolarGrid::kRing_m) / std::sqrt(directions));
      }
      figures.push_back(std::move(figure));
    }
  }
  return figures;
}

std::vector<PolarCurve> PixelDensity::Curves() const {
  std::vector<PolarCurve> curves;
  for (std::size_t purpose = 0; purpose < kPurposeCount; ++purpose) {
    const auto& [name, px_per_m] = kPurposes[purpose];
    PolarCurve curve{.id = {Measure::kPixelCurve, name},
                     .title = fmt::format("Farthest place at which cameras {} a person, in m, at "
                                          "{} px/m; gaps before it are possible",
                                          name, px_per_m),
                     .most = PolarGrid::kRings * PolarGrid::kRing_m,
                     .mean = {},
                     .worst = {}};
    for (const std::vector<double>& at_m : farthest_m_[purpose]) {
      const double sum_m = std::accumulate(at_m.begin(), at_m.end(), 0.0);
      curve.mean.push_back(sum_m / static_cast<double>(at_m.size()));
      curve.worst.push_back(*std::min_element(at_m.begin(), at_m.end()));
    }
    curves.push_back(std::move(curve));
  }
  return curves;
}

PolarMap PixelDensity::Map() const {
  PolarMap map{
      .id = {Measure::kPixelMap, fmt::format("{}", kHeight_m)},
      .title = fmt::format("Pixels per metre on a person, {} m above the ground", kHeight_m),
      .sectors = PolarGrid::kSectors,
      .rings = PolarGrid::kRings,
      .ring_m = PolarGrid::kRing_m,
      .high = kPurposes.back().px_per_m,
      .value = std::vector<double>(counted_.size(), -1),
      .ticks = {0}};
  for (const Purpose& purpose : kPurposes) map.ticks.push_back(purpose.px_per_m);
  for (std::size_t p = 0; p < counted_.size(); ++p) {
    if (counted_[p] > 0) map.value[p] = sum_px_per_m_[p] / counted_[p];
  }
  return map;
}

}  // namespace tera
