#pragma once

#include <functional>
#include <vector>

#include "core/motion.h"

/// Shape of a road on a generated site: edges, ruts, and windrows (ridges that a grader leaves)
/// along it.

namespace tera {

/// A road with one bend.
///
/// Frames  W.
struct HaulRoad {
  Vec2 begin_m = Vec2::Zero(), bend_m = Vec2::Zero(),
       end_m = Vec2::Zero();  ///< points of the centre line
  double width_m = 1;
};

/// Returns number `k` of a sequence of random numbers in [0, 1].
using ShareRow = std::function<double(std::uint32_t k)>;

/// Smooth noise in [-1, 1] along a path, with a random value every `knot_m`. Uses `shares` from
/// number `first` on.
double Wander(const ShareRow& shares, std::uint32_t first, double way_m, double knot_m);

/// Outline of the road. It continues straight far beyond both ends.
///
/// Model   straight edges with one bend. With `stray_m` > 0, edges have a corner every metre and
///         wander by noise of two wavelengths (random values every 1 m and every 6 m). If wandering
///         edges would cross, the edges stay straight.
std::vector<Vec2> RoadOutline(const HaulRoad& road, double stray_m, const ShareRow& shares);

/// A path along the road's centre line from begin to end, rounded at the bend. It wanders by up to
/// `aside_m` to either side.
std::vector<Vec2> PathAlong(const HaulRoad& road, double aside_m, const ShareRow& shares);

/// A ridge of loose soil between two points.
struct Windrow {
  Vec2 from_m = Vec2::Zero(), to_m = Vec2::Zero();
  double height_m = 0;
};

/// Ridges of 2 to 6 m along both edges, with gaps, like those that the end of a grader's blade
/// leaves. Heights are between `least_m` and `most_m`. No ridge is within `width_m` of the bend.
std::vector<Windrow> WindrowsOf(const HaulRoad& road, double least_m, double most_m,
                                const ShareRow& shares);

}  // namespace tera
