#include "sim/scenario/haul_road.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/polygon.h"
#include "core/random.h"
#include "soil/site/outline.h"

namespace tera {
namespace {

const HaulRoad kRoad{Vec2(-20, -4), Vec2(2, 3), Vec2(20, -7), 6};

ShareRow Shares(std::uint64_t episode) {
  return
      [stream = Stream(3, "road"), episode](std::uint32_t k) { return stream.Uniform(episode, k); };
}

/// Distance from the middle line.
double FromMiddle(const HaulRoad& road, const Vec2& p_m) {
  double nearest_m = 1e9;
  for (const auto& [a, b] :
       {std::pair(road.begin_m, road.bend_m), std::pair(road.bend_m, road.end_m)}) {
    const double share = std::clamp((p_m - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    nearest_m = std::min(nearest_m, (p_m - a - share * (b - a)).norm());
  }
  return nearest_m;
}

TEST(HaulRoad, EdgesStrayByNoMoreThanTheyMayAndDo) {
  const std::vector<Vec2> straight = RoadOutline(kRoad, 0, Shares(0));
  EXPECT_EQ(straight.size(), 6u);
  for (std::uint64_t episode = 0; episode < 10; ++episode) {
    const std::vector<Vec2> outline = RoadOutline(kRoad, 0.5, Shares(episode));
    EXPECT_GT(outline.size(), 50u);
    EXPECT_FALSE(FirstCrossing(outline));
    double least_m = 1e9, most_m = 0;
    for (const Vec2& p : outline) {
      const bool on_first_leg = p.x() > -19 && p.x() < -8;
      if (!on_first_leg) continue;
      least_m = std::min(least_m, FromMiddle(kRoad, p));
      most_m = std::max(most_m, FromMiddle(kRoad, p));
    }
    EXPECT_GE(least_m, 3 - 0.5);
    EXPECT_LE(most_m, 3 + 0.5);
    EXPECT_GT(most_m - least_m, 0.2) << "they are not straight";
    EXPECT_TRUE(Encloses(outline, kRoad.begin_m)) << "it begins where it should";
    EXPECT_TRUE(Encloses(outline, Vec2(120, -7 - 100 / 1.8))) << "and goes on beyond the site";
  }
}

TEST(HaulRoad, ASharpBendStillHasAnOutlineThatDoesNotCrossItself) {
  const HaulRoad hairpin{Vec2(-20, -16), Vec2(-6, 16), Vec2(20, -16), 7};
  for (std::uint64_t episode = 0; episode < 20; ++episode) {
    EXPECT_FALSE(FirstCrossing(RoadOutline(hairpin, 0.8, Shares(episode)))) << episode;
  }
}

TEST(HaulRoad, PathsStayOnItAndRoundTheBend) {
  const std::vector<Vec2> path = PathAlong(kRoad, 1.5, Shares(1));
  double sharpest_rad = 0;
  for (std::size_t k = 1; k + 1 < path.size(); ++k) {
    const Vec2 in = path[k] - path[k - 1], out = path[k + 1] - path[k];
    const double turn = std::atan2(in.x() * out.y() - in.y() * out.x(), in.dot(out));
    sharpest_rad = std::max(sharpest_rad, std::abs(turn));
  }
  // The legs meet at 46.7 deg; the road turns by much less in 1.5 m.
  EXPECT_LT(sharpest_rad, 0.5);
  for (const Vec2& p : path) {
    const bool on_first_leg = p.x() > -19 && p.x() < -8;
    if (on_first_leg) {
      EXPECT_LE(FromMiddle(kRoad, p), 1.5 + 1e-9);
    }
  }
}

TEST(HaulRoad, WindrowsLieAlongBothEdgesAndLeaveTheBendFree) {
  const std::vector<Windrow> rows = WindrowsOf(kRoad, 0.1, 0.3, Shares(2));
  EXPECT_GT(rows.size(), 8u);
  int left = 0;
  for (const Windrow& row : rows) {
    EXPECT_GE(row.height_m, 0.1);
    EXPECT_LE(row.height_m, 0.3);
    EXPECT_LE((row.to_m - row.from_m).norm(), 6 + 1e-9);
    const Vec2 middle_m = 0.5 * (row.from_m + row.to_m);
    EXPECT_NEAR(FromMiddle(kRoad, middle_m), 3, 0.5);
    EXPECT_GT((middle_m - kRoad.bend_m).norm(), 6);
    const Vec2 along = kRoad.bend_m - kRoad.begin_m, from = middle_m - kRoad.begin_m;
    left += middle_m.x() < kRoad.bend_m.x() && along.x() * from.y() - along.y() * from.x() > 0;
  }
  EXPECT_GT(left, 1);
}

}  // namespace
}  // namespace tera
