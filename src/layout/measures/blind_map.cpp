#include "layout/measures/blind_map.h"

#include <fmt/format.h>

#include <cmath>

#include "core/units.h"

namespace tera {
void BlindMap::Add(const PolarPlaces& places, const Layout& layout, const SeenFrom& seen,
                   const Sighting& sighting) {
  const std::vector<std::vector<Look>> looks = LookAt(places.p_W_m, layout, seen, sighting);
  double near_m2 = 0, far_m2 = 0;
  for (int sector = 0; sector < PolarGrid::kSectors; ++sector) {
    for (int ring = 0; ring < PolarGrid::kRings; ++ring) {
      const std::size_t i = PolarGrid::Index(sector, ring);
      if (!places.count[i]) continue;
      counted_[i] += 1;
      if (SeenBy(looks[i]) > 0) {
        seen_[i] += 1;
        continue;
      }
      far_m2 += PolarGrid::Area_m2(ring);
      if (ring < PolarGrid::kNearRings) near_m2 += PolarGrid::Area_m2(ring);
    }
  }
  near_blind_m2_.push_back(near_m2);
  far_blind_m2_.push_back(far_m2);
}

std::vector<double> BlindMap::SeenShare() const {
  std::vector<double> share(seen_.size(), -1);
  for (std::size_t i = 0; i < seen_.size(); ++i) {
    if (counted_[i] > 0) share[i] = seen_[i] / counted_[i];
  }
  return share;
}

std::vector<Figure> BlindMap::Figures() const {
  const auto figure = [&](Measure measure, const std::vector<double>& blind_m2) {
    Figure f{{measure, fmt::format("{}", height_m_)}, blind_m2, {}};
    // Error estimate: the blind area is treated as a disc. Its border crosses a number of cells
    // equal to its length in ring widths. In each such cell the position of the border is uniform
    // and independent.
    for (const double area_m2 : blind_m2) {
      const double border_m = 2 * std::sqrt(kPi * area_m2);
      const double cell_m2 = PolarGrid::kRing_m * EvenSigma(PolarGrid::kRing_m);
      f.error.push_back(cell_m2 * std::sqrt(border_m / PolarGrid::kRing_m));
    }
    return f;
  };
  return {figure(Measure::kBlindAreaNear, near_blind_m2_),
          figure(Measure::kBlindAreaFar, far_blind_m2_)};
}

}  // namespace tera
