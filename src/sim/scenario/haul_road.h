#pragma once

#include <functional>
#include <vector>

#include "core/motion.h"

/// Shape of a road over a generated site: its edges, a grader's windrows along it, and ruts.

namespace tera {

/// Frames  W.
struct HaulRoad {
  Vec2 begin_m = Vec2::Zero(), bend_m = Vec2::Zero(),
       end_m = Vec2::Zero();  ///< points of its middle line
  double width_m = 1;
};

/// Number `k` of a row of random shares from 0 to 1.
using ShareRow = std::function<double(std::uint32_t k)>;

/// A smooth function of the way from -1 to 1 with a knot every `knot_m`. Its shares begin at number
/// `first`.
double Wander(const ShareRow& shares, std::uint32_t first, double way_m, double knot_m);

/// The outline of the road, which continues straight far beyond its ends.
///
/// Model   edges straight with one bend. If they stray, corners lie 1 m apart; their distance from
///         the straight edge is a sum of two rows of shares, smooth over 1 m and over 6 m. Edges
///         that would cross themselves stay straight.
std::vector<Vec2> RoadOutline(const HaulRoad& road, double stray_m, const ShareRow& shares);

/// A path along the road's middle from its begin to its end, rounded at the bend, that wanders by
/// up to `aside_m` to either side.
std::vector<Vec2> PathAlong(const HaulRoad& road, double aside_m, const ShareRow& shares);

/// A ridge of loose soil from one point to another.
struct Windrow {
  Vec2 from_m = Vec2::Zero(), to_m = Vec2::Zero();
  double height_m = 0;
};

/// Ridges of 2 to 6 m in a row along both edges, with gaps, as the end of a grader's blade leaves
/// them. None is within `width_m` of the bend.
std::vector<Windrow> WindrowsOf(const HaulRoad& road, double least_m, double most_m,
                                const ShareRow& shares);

}  // namespace tera
