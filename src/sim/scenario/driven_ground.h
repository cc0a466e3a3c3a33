#pragma once

#include <vector>

#include "core/motion.h"
#include "sim/scenario/haul_road.h"

/// What a site has of the time before: the ways of machines that crossed it, and patches of soil
/// that was spilled or spread.

namespace tera {

/// The way of a machine that drove on from `start_W_m`, by points 1 m apart: `count` of them at
/// most, and none after the first beyond the rectangle. Straight for 12 m before and after.
///
/// Model   the curvature is a row of shares, smooth over 6 m, of up to 1 / `tightest_m`.
std::vector<Vec2> DrivenPath(const Vec2& start_W_m, double heading_rad, double tightest_m,
                             const Vec2& least_W_m, const Vec2& most_W_m, int count,
                             const ShareRow& shares);

/// The outline of a patch about `middle_W_m`: a circle whose radius varies about `radius_m` by up
/// to 0.44 of it, in three waves of 2, 3 and 5 to the turn. It does not cross itself.
std::vector<Vec2> PatchOutline(const Vec2& middle_W_m, double radius_m, const ShareRow& shares);

}  // namespace tera
