#pragma once

#include <vector>

#include "core/motion.h"
#include "sim/scenario/haul_road.h"

/// Traces of earlier work on a site: tracks of machines that crossed it, and patches of soil.

namespace tera {

/// The path of a machine from `start_W_m`: at most `count` points, 1 m apart. It ends at the first
/// point outside the given rectangle. Straight pieces of 12 m extend it at both ends.
///
/// Model   the curvature is smooth noise of at most 1 / `tightest_m`, with a random value every 6
///         m.
std::vector<Vec2> DrivenPath(const Vec2& start_W_m, double heading_rad, double tightest_m,
                             const Vec2& least_W_m, const Vec2& most_W_m, int count,
                             const ShareRow& shares);

/// Outline of a patch around `middle_W_m`. The radius varies by up to 0.44 of `radius_m`, as the
/// sum of three waves with 2, 3 and 5 periods per turn. The outline does not cross itself.
std::vector<Vec2> PatchOutline(const Vec2& middle_W_m, double radius_m, const ShareRow& shares);

}  // namespace tera
