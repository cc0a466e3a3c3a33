#include "layout/measures/polar_grid.h"

#include <cmath>

#include "core/units.h"

namespace tera {
namespace {

constexpr double kGridSector_rad = 2 * kPi / PolarGrid::kSectors;

}  // namespace

bool IsOnSite(const TerrainGrid& grid, const Vec3& p_W_m) {
  return p_W_m.x() >= grid.x_m(0) && p_W_m.x() <= grid.x_m(grid.nx - 1) &&
         p_W_m.y() >= grid.y_m(0) && p_W_m.y() <= grid.y_m(grid.ny - 1);
}

double PolarGrid::Azimuth_rad(int sector) { return sector * kGridSector_rad; }

Vec2 PolarGrid::Middle_m(int sector, int ring) {
  const double azimuth_rad = Azimuth_rad(sector), radius_m = Radius_m(ring);
  return {radius_m * std::cos(azimuth_rad), radius_m * std::sin(azimuth_rad)};
}

double PolarGrid::Area_m2(int ring) {
  const double low_m = ring * kRing_m, high_m = low_m + kRing_m;
  return 0.5 * kGridSector_rad * (high_m * high_m - low_m * low_m);
}

PolarPlaces PlacesAt(double height_m, const Pose& X_WH, const Sighting& sighting,
                     const TerrainSurface& ground) {
  PolarPlaces places;
  for (int sector = 0; sector < PolarGrid::kSectors; ++sector) {
    for (int ring = 0; ring < PolarGrid::kRings; ++ring) {
      const Vec2 xy_m = PolarGrid::Middle_m(sector, ring);
      Vec3 p_W_m = X_WH * Vec3(xy_m.x(), xy_m.y(), 0);
      p_W_m.z() = ground.HeightAt(p_W_m.x(), p_W_m.y()) + height_m;
      places.p_W_m.push_back(p_W_m);
    }
  }
  places.count = sighting.AreInside(places.p_W_m);
  places.count.flip();
  for (std::size_t p = 0; p < places.count.size(); ++p) {
    if (!IsOnSite(ground, places.p_W_m[p])) places.count[p] = false;
  }
  return places;
}

void LeaveOutHull(const std::vector<double>& hull_m, PolarPlaces* places) {
  for (int sector = 0; sector < PolarGrid::kSectors; ++sector) {
    for (int ring = 0; ring < PolarGrid::kRings; ++ring) {
      if (PolarGrid::Radius_m(ring) < hull_m[static_cast<std::size_t>(sector)]) {
        places->count[PolarGrid::Index(sector, ring)] = false;
      }
    }
  }
}

}  // namespace tera
