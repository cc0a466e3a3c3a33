#pragma once

#include <vector>

#include "core/motion.h"

namespace tera {

/// What is ground, and what stands on it.
///
/// Model   The lowest points of squares go through a progressive morphological filter (PCL's, over
///         windows that grow to the largest thing): what rises out of the opened surface by more
///         than `clearance_m` and what a slope of `opening_slope_rad` explains is cut off, heaps of
///         soil with it. Ground then grows back over the squares whose lowest point is no higher
///         above a neighbour that is ground than `clearance_m` and a slope of `steepest_rad`: up a
///         heap, whose sides slope, but not up a wall. A point is ground unless it is more than
///         `least_height_m` above the highest ground of its square and the eight around it.
/// Omits   what hangs over (a bridge is cut off, or, if it is broad, is ground); things lower than
///         about 0.5 m, which stay part of the terrain; a block of ground between trenches that is
///         narrower than the largest thing is taken for one where all its sides are walls.
/// Source  Zhang et al. 2003, "A progressive morphological filter for removing nonground
///         measurements from airborne LIDAR data".
struct GroundRule {
  double square_m = 0.3;
  double largest_thing_m = 6;  ///< the smaller side of what stands on the ground
  double opening_slope_rad = 0.26;
  double steepest_rad = 0.79;
  double clearance_m = 0.1;
  double least_height_m = 0.3;
};

/// Of each point, how high it is above the ground that GroundRule allows; not more than 0 for
/// ground.
std::vector<float> HeightsAboveGround(const std::vector<Vec3>& p_m, const GroundRule& rule);

}  // namespace tera
