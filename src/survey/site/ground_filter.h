#pragma once

#include <vector>

#include "core/motion.h"

namespace tera {

/// Rule that separates the ground from objects on it.
///
/// Model   1. PCL's progressive morphological filter runs over the lowest point of each grid
///         square. Its windows grow up to the size of the largest object. It removes points that
///         are above the opened surface by more than `clearance_m` plus a slope of
///         `opening_slope_rad`. This also removes heaps of soil.
///
///         2. The ground grows back from square to square: the lowest point of the next square may
///         be higher by `clearance_m` plus a slope of `steepest_rad`. The ground thus grows up a
///         heap but not up a wall.
///
///         3. A point is ground if it is at most `least_height_m` above the highest ground of its
///         square and the eight neighbours.
/// Omits   overhangs: a bridge is removed, or is ground if it is broad. Objects lower than about
///         0.5 m remain in the terrain. A block of ground between trenches counts as an object if
///         it is surrounded by walls and narrower than the largest object.
/// Source  Zhang et al. 2003, "A progressive morphological filter for removing nonground
///         measurements from airborne LIDAR data".
struct GroundRule {
  double square_m = 0.3;
  double largest_thing_m = 6;  ///< shorter side of the largest object on the ground
  double opening_slope_rad = 0.26;
  double steepest_rad = 0.79;
  double clearance_m = 0.1;
  double least_height_m = 0.3;
};

/// Height of each point above the highest ground that GroundRule allows; 0 or less for a ground
/// point.
std::vector<float> HeightsAboveGround(const std::vector<Vec3>& p_m, const GroundRule& rule);

}  // namespace tera
