#pragma once

#include <vector>

#include "layout/sight/sighting.h"

namespace tera {

/// A polar grid of places at one height above the ground, about the machine.
///
/// Frames  H stands on the ground at the upper structure's origin, turned to its heading: azimuth 0
///         is ahead, counterclockwise from above.
/// Source  5 degrees by 1 m, out to 12 and 24 m: the grid of the blind area diagrams of NIOSH and
///         Caterpillar (planes at 0, 900 and 1500 mm).
struct PolarGrid {
  static constexpr int kSectors = 72, kRings = 24, kNearRings = 12;
  static constexpr double kRing_m = 1.0;

  static double Azimuth_rad(int sector);
  /// From the origin to the middle of a cell.
  static double Radius_m(int ring) { return (ring + 0.5) * kRing_m; }
  /// Middle of a cell, x and y in H.
  static Vec2 Middle_m(int sector, int ring);
  static double Area_m2(int ring);
  static std::size_t Index(int sector, int ring) {
    return static_cast<std::size_t>(sector) * kRings + ring;
  }
};

/// Whether a place has the site's ground below or above it.
bool IsOnSite(const TerrainGrid& site, const Vec3& p_W_m);

/// The middles of the cells, by PolarGrid::Index.
struct PolarPlaces {
  std::vector<Vec3> p_W_m;
  std::vector<bool> count;  ///< it lies over the site's ground and in nothing solid
};
PolarPlaces PlacesAt(double height_m, const Pose& X_WH, const Sighting& sighting,
                     const TerrainSurface& ground);
/// Places nearer than the hull of the machine in their direction do not count. `hull_m` is
/// HullRadii_m of kSectors sectors.
void LeaveOutHull(const std::vector<double>& hull_m, PolarPlaces* places);

}  // namespace tera
