#include "sim/operators/trench_work.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/units.h"

namespace tera {
namespace {

using testing::DoubleNear;

constexpr double kCell_m = 0.05;

/// Level ground of 12 x 12 m about the origin.
TerrainSurface LevelGround() {
  TerrainGrid grid;
  grid.origin_W_m = Vec2(-6, -6);
  grid.cell_m = kCell_m;
  grid.nx = grid.ny = 241;
  return TerrainSurface(grid);
}

/// A trench of 6 m, 1 m deep, along the direction (0.6, 0.8); the bucket is 0.6 m wide.
TrenchPlan SlantedTrench(double width_m) {
  const Vec2 along(0.6, 0.8), half = 0.5 * width_m * Vec2(-0.8, 0.6);
  const Vec2 from(-1.8, -2.4), to = from + 6 * along;
  TrenchPlan plan;
  plan.task.trench = TrenchLine{from, to, width_m, 1};
  plan.task.design = {.corners_W_m = {from - half, to - half, to + half, from + half},
                      .at_W_m = from,
                      .floor_m = -1};
  plan.bucket_m = 0.6;
  plan.near_m = 2.4;
  plan.far_m = 4.4;
  return plan;
}

/// Sets the ground of the trench between two stations.
void SetGround(const TrenchWork& trench, double from_m, double to_m, float height_m,
               TerrainSurface* ground) {
  for (int j = 0; j < ground->ny; ++j) {
    for (int i = 0; i < ground->nx; ++i) {
      const Vec2 xy_m(ground->x_m(i), ground->y_m(j));
      const double station_m = trench.StationOf(xy_m);
      if (station_m < from_m || station_m > to_m || std::abs(trench.OffsetOf(xy_m)) > 0.4) continue;
      ground->Set(i, j, {.height_m = height_m, .cover = {}});
    }
  }
}

TEST(TrenchWork, BacksFromStandToStandUntilItReachesTheOtherEnd) {
  const TrenchWork trench(SlantedTrench(0.6));
  // From 0.15 m within 4.4 m to as much beyond 6 + 2.4 m, in moves of at most 1.5 m.
  double stand_m = trench.first_stand_m();
  EXPECT_NEAR(stand_m, 4.25, 1e-9);
  for (const double expected_m : {4.25 + 4.3 / 3, 4.25 + 8.6 / 3, 8.55}) {
    const std::optional<double> next_m = trench.NextStand(stand_m);
    ASSERT_TRUE(next_m);
    EXPECT_NEAR(*next_m, expected_m, 1e-9);
    stand_m = *next_m + 0.03;  // it does not stop to the centimetre
  }
  EXPECT_FALSE(trench.NextStand(stand_m));
}

TEST(TrenchWork, HasOneStandForATrenchWithinReach) {
  TrenchPlan plan = SlantedTrench(0.6);
  plan.task.trench->to_W_m = plan.task.trench->from_W_m + 1.5 * Vec2(0.6, 0.8);
  EXPECT_FALSE(TrenchWork(plan).NextStand(4.4));
}

TEST(TrenchWork, CutsFirstFarthestAwayAsLongAsFillsTheBucket) {
  const TrenchWork trench(SlantedTrench(0.6));
  const auto cut = trench.NextCut(LevelGround(), 4.4, 0.2, 0.096);
  ASSERT_TRUE(cut);
  EXPECT_NEAR(cut->reach_m, 4.4, 1e-9);
  EXPECT_NEAR(cut->length_m, 0.096 / (0.2 * 0.6), kCell_m);
}

TEST(TrenchWork, GoesOnWhereTheFloorIsNotReached) {
  const TrenchWork trench(SlantedTrench(0.6));
  TerrainSurface ground = LevelGround();
  SetGround(trench, -0.1, 1.0, -0.98F, &ground);
  const auto cut = trench.NextCut(ground, 4.4, 0.2, 0.096);
  ASSERT_TRUE(cut);
  EXPECT_NEAR(4.4 - cut->reach_m, 1.0, 2 * kCell_m);
}

TEST(TrenchWork, LeavesTheNearestSoilToTheNextStandButNotAtTheLast) {
  const TrenchWork trench(SlantedTrench(0.6));
  TerrainSurface ground = LevelGround();
  SetGround(trench, -0.1, 1.8, -1.0F, &ground);
  EXPECT_FALSE(trench.NextCut(ground, 4.4, 0.2, 0.096));  // it reaches as far as station 2
  SetGround(trench, -0.1, 5.8, -1.0F, &ground);
  const auto cut = trench.NextCut(ground, 8.55, 0.2, 0.096);
  ASSERT_TRUE(cut);
  EXPECT_NEAR(8.55 - (cut->reach_m - cut->length_m), 6.0, 2 * kCell_m);
}

TEST(TrenchWork, LeavesWhatIsWithinTheTolerance) {
  const TrenchWork trench(SlantedTrench(0.6));
  TerrainSurface ground = LevelGround();
  SetGround(trench, -0.1, 6.1, -0.98F, &ground);
  EXPECT_FALSE(trench.NextCut(ground, 4.4, 0.2, 0.096));
  SetGround(trench, 1.0, 1.5, -0.93F, &ground);
  const auto cut = trench.NextCut(ground, 4.4, 0.2, 0.096);
  ASSERT_TRUE(cut);
  EXPECT_GT(cut->reach_m, 4.4 - 1.05);
  EXPECT_LT(cut->reach_m - cut->length_m, 4.4 - 1.45);
}

TEST(TrenchWork, EndsAPullBeforeAStepThatWouldTipTheMachine) {
  const TrenchWork trench(SlantedTrench(0.6));
  TerrainSurface ground = LevelGround();
  SetGround(trench, -0.1, 1.2, -0.92F, &ground);  // 8 cm are left as far as the step at 1.2 m
  // Up to the step the crumbs are 0.058 m3 and do not fill the bucket. On the step there is less.
  const auto cut = trench.NextCut(ground, 4.4, 0.1, 0.096);
  ASSERT_TRUE(cut);
  EXPECT_NEAR(cut->reach_m, 4.4, 1e-9);
  EXPECT_GT(cut->length_m, 1.1);
  EXPECT_LT(cut->length_m, 1.3);
}

TEST(TrenchWork, DoesNotCutBeyondTheEndsOfTheTrench) {
  const TrenchWork trench(SlantedTrench(0.6));
  const TerrainSurface ground = LevelGround();
  const auto first = trench.NextCut(ground, 3.0, 0.2, 10);  // too near: the end is at 3 m
  ASSERT_TRUE(first);
  EXPECT_LE(first->reach_m, 3.0 + 1e-9);
  const auto last = trench.NextCut(ground, 9.0, 0.2, 10);
  ASSERT_TRUE(last);
  EXPECT_GE(last->reach_m - last->length_m, 3.0 - 1e-9);
}

TEST(TrenchWork, CutsAWideTrenchInStripsFromSideToSide) {
  const TrenchWork trench(SlantedTrench(1.5));
  TerrainSurface ground = LevelGround();
  const auto first = trench.NextCut(ground, 4.4, 0.2, 0.096);
  ASSERT_TRUE(first);
  EXPECT_THAT(std::abs(first->offset_m), DoubleNear(0.45, 1e-9));
}

TEST(TrenchWork, SeesTheHighestGroundBesideTheTrench) {
  const TrenchWork trench(SlantedTrench(0.6));
  TerrainSurface ground = LevelGround();
  SetGround(trench, 0.0, 2.0, -1.0F, &ground);
  EXPECT_NEAR(trench.Rim_m(ground, 4.4), 0, 1e-6);
  const Vec2 beside_m = trench.PlaceAt(1.0, 0.6);
  ground.Set(static_cast<int>(std::lround((beside_m.x() + 6) / kCell_m)),
             static_cast<int>(std::lround((beside_m.y() + 6) / kCell_m)),
             {.height_m = 0.3F, .cover = {}});
  EXPECT_GT(trench.Rim_m(ground, 4.4), 0.1);
}

}  // namespace
}  // namespace tera
