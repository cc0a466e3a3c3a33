#pragma once

#include <vector>

#include "layout/sight/sighting.h"

namespace tera {

/// A polar grid of places around the machine at one height above the ground.
///
/// Frames  H stands upright on the ground at the upper structure's origin and has its heading.
///         Azimuth 0 is ahead and increases counterclockwise, seen from above.
/// Source  cells of 5 degrees by 1 m, out to 12 and 24 m, as in the blind area diagrams of NIOSH
///         and Caterpillar (planes at 0, 900 and 1500 mm).
struct PolarGrid {
  static constexpr int kSectors = 72, kRings = 24, kNearRings = 12;
  static constexpr double kRing_m = 1.0;

  static double Azimuth_rad(int sector);
  /// Distance from the origin to the centre of a cell.
  static double Radius_m(int ring) { return (ring + 0.5) * kRing_m; }
  /// Centre of a cell, x and y in H.
  static Vec2 Middle_m(int sector, int ring);
  static double Area_m2(int ring);
  static std::size_t Index(int sector, int ring) {
    return static_cast<std::size_t>(sector) * kRings + ring;
  }
};

/// Whether the site's ground extends below or above a place.
bool IsOnSite(const TerrainGrid& site, const Vec3& p_W_m);

/// The centres of the cells, by PolarGrid::Index.
struct PolarPlaces {
  std::vector<Vec3> p_W_m;
  std::vector<bool> count;  ///< lies over the site's ground and outside solid objects
};
PolarPlaces PlacesAt(double height_m, const Pose& X_WH, const Sighting& sighting,
                     const TerrainSurface& ground);
/// Stops counting the places that are nearer than the machine's hull in their direction. `hull_m`
/// is HullRadii_m of kSectors sectors.
void LeaveOutHull(const std::vector<double>& hull_m, PolarPlaces* places);

}  // namespace tera
