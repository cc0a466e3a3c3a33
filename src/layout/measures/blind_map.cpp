#include "layout/measures/blind_map.h"

#include <fmt/format.h>

#include <cmath>

#include "core/units.h"

namespace tera {
namespace {

constexpr double kSector_rad = 2 * kPi / PolarGrid::kSectors;
/// Half of a ring: the border of an area is known to half a cell, evenly.
constexpr double kEven = 0.28867513459481287;  ///< 1 / sqrt(12)

double Area_m2(int ring) {
  const double low_m = ring * PolarGrid::kRing_m, high_m = low_m + PolarGrid::kRing_m;
  return 0.5 * kSector_rad * (high_m * high_m - low_m * low_m);
}

bool IsOnSite(const TerrainGrid& grid, const Vec3& p_W_m) {
  return p_W_m.x() >= grid.x_m(0) && p_W_m.x() <= grid.x_m(grid.nx - 1) &&
         p_W_m.y() >= grid.y_m(0) && p_W_m.y() <= grid.y_m(grid.ny - 1);
}

}  // namespace

Vec2 PolarGrid::Middle_m(int sector, int ring) {
  const double azimuth_rad = sector * kSector_rad, radius_m = (ring + 0.5) * kRing_m;
  return {radius_m * std::cos(azimuth_rad), radius_m * std::sin(azimuth_rad)};
}

std::vector<BlindMap::Place> BlindMap::Places(const Pose& X_WH, const std::vector<double>& hull_m,
                                              const Sighting& sighting,
                                              const TerrainSurface& ground) const {
  std::vector<Place> on_site;
  std::vector<Vec3> places_W_m;
  for (int sector = 0; sector < PolarGrid::kSectors; ++sector) {
    for (int ring = 0; ring < PolarGrid::kRings; ++ring) {
      const Vec2 xy_m = PolarGrid::Middle_m(sector, ring);
      Vec3 p_W_m = X_WH * Vec3(xy_m.x(), xy_m.y(), 0);
      if (xy_m.norm() < hull_m[sector] || !IsOnSite(ground, p_W_m)) continue;
      p_W_m.z() = ground.HeightAt(p_W_m.x(), p_W_m.y()) + height_m_;
      on_site.push_back({PolarGrid::Index(sector, ring), p_W_m});
      places_W_m.push_back(p_W_m);
    }
  }
  const std::vector<bool> inside = sighting.AreInside(places_W_m);
  std::vector<Place> places;
  for (std::size_t i = 0; i < on_site.size(); ++i) {
    if (!inside[i]) places.push_back(on_site[i]);
  }
  return places;
}

void BlindMap::Add(const std::vector<Place>& places, const Layout& layout, const SeenFrom& seen,
                   const Sighting& sighting) {
  std::vector<Vec3> places_W_m;
  for (const Place& place : places) places_W_m.push_back(place.p_W_m);
  const std::vector<std::vector<Look>> looks = LookAt(places_W_m, layout, seen, sighting);
  double near_m2 = 0, far_m2 = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    counted_[places[i].cell] += 1;
    if (SeenBy(looks[i]) > 0) {
      seen_[places[i].cell] += 1;
      continue;
    }
    const int ring = static_cast<int>(places[i].cell % PolarGrid::kRings);
    far_m2 += Area_m2(ring);
    if (ring < PolarGrid::kNearRings) near_m2 += Area_m2(ring);
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
  const auto figure = [&](int rings, const std::vector<double>& blind_m2) {
    Figure f{fmt::format("map/{} m/blind_m2_to_{:.0f}m", height_m_, rings * PolarGrid::kRing_m),
             "m^2",
             false,
             blind_m2,
             {}};
    // As if the blind area were round: its border is known to a cell's even spread, and cells on it
    // err independently.
    for (const double area_m2 : blind_m2) {
      const double border_m = 2 * std::sqrt(kPi * area_m2);
      f.error.push_back(kEven * PolarGrid::kRing_m * std::sqrt(border_m * PolarGrid::kRing_m));
    }
    return f;
  };
  return {figure(PolarGrid::kNearRings, near_blind_m2_), figure(PolarGrid::kRings, far_blind_m2_)};
}

}  // namespace tera
