#pragma once

#include <vector>

#include "core/motion.h"

namespace tera {

/// Rule that separates the ground from things that stand on it.
///
/// Model   A progressive morphological filter (PCL's) runs over the lowest points of squares, with
///         windows that grow to the largest thing. It cuts off points that rise above the opened
///         surface by more than `clearance_m` plus a slope of `opening_slope_rad`; this also cuts
///         off heaps of soil. The ground then grows back from square to square: the lowest point
///         may rise by `clearance_m` plus a slope of `steepest_rad`. It grows up a heap, whose
///         sides slope, but not up a wall. A point is ground unless it is more than
///         `least_height_m` above the highest ground of its square and its eight neighbours.
/// Omits   overhangs: a bridge is cut off, or is ground if it is broad. Things lower than about 0.5
///         m stay part of the terrain. A block of ground between trenches counts as a thing if it
///         is narrower than the largest thing and walls surround it.
/// Source  Zhang et al. 2003, "A progressive morphological filter for removing nonground
///         measurements from airborne LIDAR data".
struct GroundRule {
  double square_m = 0.3;
  double largest_thing_m = 6;  ///< the smaller side of a thing on the ground
  double opening_slope_rad = 0.26;
  double steepest_rad = 0.79;
  double clearance_m = 0.1;
  double least_height_m = 0.3;
};

/// Height of each point above the ground that GroundRule allows; at most 0 for ground.
std::vector<float> HeightsAboveGround(const std::vector<Vec3>& p_m, const GroundRule& rule);

}  // namespace tera
