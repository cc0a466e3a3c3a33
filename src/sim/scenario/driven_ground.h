#pragma once

#include <vector>

#include "core/motion.h"
#include "sim/scenario/haul_road.h"

/// Traces of earlier work on a site: tracks of machines that crossed it, and patches of spilled or
/// spread soil.

namespace tera {

/// The path of a machine from `start_W_m` on, as at most `count` points 1 m apart. It ends at the
/// first point outside the rectangle. Straight pieces of 12 m extend it at both ends.
///
/// Model   the curvature is a row of shares, smooth over 6 m, of up to 1 / `tightest_m`.
std::vector<Vec2> DrivenPath(const Vec2& start_W_m, double heading_rad, double tightest_m,
                             const Vec2& least_W_m, const Vec2& most_W_m, int count,
                             const ShareRow& shares);

/// The outline of a patch about `middle_W_m`: a circle whose radius varies about `radius_m` by up
/// to 0.44 of it, in three waves of 2, 3 and 5 per turn. It does not cross itself.
std::vector<Vec2> PatchOutline(const Vec2& middle_W_m, double radius_m, const ShareRow& shares);

}  // namespace tera
