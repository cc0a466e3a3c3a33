#include "sim/scenario/haul_road.h"

#include <algorithm>
#include <cmath>

#include "core/polygon.h"

namespace tera {
namespace {

constexpr double kBeyond_m = 500;  // length of the road beyond the site's border

Vec2 LeftOf(const Vec2& from_m, const Vec2& to_m) {
  const Vec2 way = (to_m - from_m).normalized();
  return {-way.y(), way.x()};
}

/// A point of the centre line, and the direction to its left.
struct Station {
  double way_m;
  Vec2 p_m, left;
};

/// Points along the centre line, from `before_m` before its begin to `before_m` after its end. The
/// bend is rounded over `round_m` on each leg.
std::vector<Station> StationsOf(const HaulRoad& road, double before_m, double step_m,
                                double round_m) {
  const Vec2 first = road.bend_m - road.begin_m, last = road.end_m - road.bend_m;
  const double first_m = first.norm(), last_m = last.norm();
  const double reach_m = std::min({round_m, 0.45 * first_m, 0.45 * last_m});
  const Vec2 in = first / first_m, out = last / last_m;
  const auto point = [&](double way_m) {
    const double from_bend_m = way_m - first_m;
    if (std::abs(from_bend_m) >= reach_m) {
      return Vec2(road.bend_m + from_bend_m * (from_bend_m < 0 ? in : out));
    }
    // A parabola tangent to both legs (a Bezier curve of the second degree).
    const double t = 0.5 * (from_bend_m / reach_m + 1);
    return Vec2(road.bend_m - (1 - t) * (1 - t) * reach_m * in + t * t * reach_m * out);
  };
  std::vector<Station> stations;
  const double total_m = first_m + last_m + 2 * before_m;
  const int steps = static_cast<int>(total_m / step_m);
  for (int k = 0; k <= steps; ++k) {
    const double way_m = total_m * k / steps, at_m = way_m - before_m;
    constexpr double kBit_m = 0.01;
    stations.push_back({way_m, point(at_m), LeftOf(point(at_m - kBit_m), point(at_m + kBit_m))});
  }
  return stations;
}

std::vector<Vec2> StraightOutline(const HaulRoad& road) {
  const double half_m = 0.5 * road.width_m;
  const Vec2 first = half_m * LeftOf(road.begin_m, road.bend_m);
  const Vec2 last = half_m * LeftOf(road.bend_m, road.end_m);
  const Vec2 middle = half_m * LeftOf(road.begin_m, road.end_m);
  const Vec2 from_far = road.begin_m - kBeyond_m * (road.bend_m - road.begin_m).normalized();
  const Vec2 to_far = road.end_m + kBeyond_m * (road.end_m - road.bend_m).normalized();
  return {from_far + first, from_far - first, road.bend_m - middle,
          to_far - last,    to_far + last,    road.bend_m + middle};
}

}  // namespace

double Wander(const ShareRow& shares, std::uint32_t first, double way_m, double knot_m) {
  const double at = std::max(way_m / knot_m, 0.0);
  const auto k = static_cast<std::uint32_t>(at);
  const double t = at - k, smooth = t * t * (3 - 2 * t);
  const double a = shares(first + k), b = shares(first + k + 1);
  return 2 * (a + (b - a) * smooth) - 1;
}

std::vector<Vec2> RoadOutline(const HaulRoad& road, double stray_m, const ShareRow& shares) {
  const std::vector<Vec2> straight = StraightOutline(road);
  if (stray_m <= 0) return straight;
  constexpr double kStep_m = 1, kFine_m = 1, kCoarse_m = 6, kPastEnds_m = 12;
  constexpr std::uint32_t kRow = 2000;  // random numbers reserved for each noise
  const std::vector<Station> stations = StationsOf(road, kPastEnds_m, kStep_m, road.width_m);
  std::vector<Vec2> left, right;
  for (const Station& s : stations) {
    const auto aside_m = [&](std::uint32_t side) {
      const double stray = 0.35 * Wander(shares, (2 * side) * kRow, s.way_m, kFine_m) +
                           0.65 * Wander(shares, (2 * side + 1) * kRow, s.way_m, kCoarse_m);
      return std::max(0.5 * road.width_m + stray_m * stray, 0.1 * road.width_m);
    };
    left.push_back(s.p_m + aside_m(0) * s.left);
    right.push_back(s.p_m - aside_m(1) * s.left);
  }
  std::vector<Vec2> outline = {straight[0], straight[1]};
  outline.insert(outline.end(), right.begin(), right.end());
  outline.insert(outline.end(), {straight[3], straight[4]});
  outline.insert(outline.end(), left.rbegin(), left.rend());
  return FirstCrossing(outline) ? straight : outline;
}

std::vector<Vec2> PathAlong(const HaulRoad& road, double aside_m, const ShareRow& shares) {
  constexpr double kStep_m = 1.5, kKnot_m = 9, kPastEnds_m = 12;
  std::vector<Vec2> path_m;
  for (const Station& s : StationsOf(road, kPastEnds_m, kStep_m, 1.5 * road.width_m)) {
    path_m.push_back(s.p_m + aside_m * Wander(shares, 0, s.way_m, kKnot_m) * s.left);
  }
  return path_m;
}

std::vector<Windrow> WindrowsOf(const HaulRoad& road, double least_m, double most_m,
                                const ShareRow& shares) {
  constexpr double kShortest_m = 2;
  std::vector<Windrow> windrows;
  std::uint32_t drawn = 0;
  for (const auto& [from_m, to_m] :
       {std::pair(road.begin_m, road.bend_m), std::pair(road.end_m, road.bend_m)}) {
    const double length_m = (to_m - from_m).norm() - road.width_m;
    const Vec2 along = (to_m - from_m).normalized();
    for (const double side : {-1.0, 1.0}) {
      for (double way_m = 2 * shares(drawn++); way_m < length_m;) {
        const double end_m = std::min(way_m + kShortest_m + 4 * shares(drawn++), length_m);
        const double height_m = least_m + (most_m - least_m) * shares(drawn++);
        const double aside_m = side * (0.5 * road.width_m + 0.5 * (shares(drawn++) - 0.3));
        const Vec2 out_m = aside_m * LeftOf(from_m, to_m);
        if (end_m - way_m >= kShortest_m) {  // the last ridge may not fit
          windrows.push_back(
              {from_m + way_m * along + out_m, from_m + end_m * along + out_m, height_m});
        }
        way_m = end_m + 2.5 * shares(drawn++);
      }
    }
  }
  return windrows;
}

}  // namespace tera
