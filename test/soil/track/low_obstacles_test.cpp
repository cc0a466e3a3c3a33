#include "soil/track/low_obstacles.h"

#include <gtest/gtest.h>

#include "core/units.h"

namespace tera {
namespace {

constexpr double kClimb_m = 0.2;

/// A board of 2 m x 1 m x 0.1 m, its lower face 0.05 m over its carrier's frame.
RigidObstacle Board(double rise_m = 0.15) {
  return {{{MakePose(Vec3(0, 0, 0.1)), Vec3(2, 1, 0.1)}}, rise_m};
}

/// At (3, -1), turned so that its long side is along y, and moving.
BodyState Carrier() {
  BodyState carrier;
  carrier.X_WB = MakePose(Vec3(3, -1, 0.4), 0, 0, 90 * kDeg);
  carrier.v_WB_mps = Vec3(0.3, 0.1, 0);
  carrier.w_WB_radps = Vec3(0, 0, 0.5);
  return carrier;
}

TEST(LowObstacles, HaveTheirUpperFacesHeightAndSlopeOffBesideIt) {
  LowObstacles obstacles;
  obstacles.Move(obstacles.Add(Board()), Carrier());
  const auto top = obstacles.TopAt(3.4, -0.2, kClimb_m);
  ASSERT_TRUE(top);
  EXPECT_NEAR(top->z_m, 0.4 + 0.15, 1e-12);
  // w x r with r = (0.4, 0.8): 0.5 * (-0.8, 0.4).
  EXPECT_NEAR((top->v_W_mps - Vec3(0.3 - 0.4, 0.1 + 0.2, 0)).norm(), 0, 1e-12);
  // 3 cm beside its edge at x = 3.5; 3 and 4 cm beside its corner.
  EXPECT_NEAR(obstacles.TopAt(3.53, -0.2, kClimb_m)->z_m, 0.55 - 0.03, 1e-12);
  EXPECT_NEAR(obstacles.TopAt(3.53, 0.04, kClimb_m)->z_m, 0.55 - 0.05, 1e-12);
  EXPECT_FALSE(obstacles.TopAt(3.61, -0.2, kClimb_m));
}

TEST(LowObstacles, AreNotThereForWhoCannotClimbThem) {
  LowObstacles obstacles;
  obstacles.Move(obstacles.Add(Board(0.21)), Carrier());
  EXPECT_FALSE(obstacles.TopAt(3, -1, kClimb_m));
  EXPECT_FALSE(obstacles.ExitFrom(Vec3(3, -1, 0.5), kClimb_m));
  EXPECT_TRUE(obstacles.TopAt(3, -1, 0.22));
}

TEST(LowObstacles, TheHighestOfSeveralBears) {
  LowObstacles obstacles;
  obstacles.Move(obstacles.Add(Board()), Carrier());
  BodyState above = Carrier();
  above.X_WB.translation().z() += 0.05;
  obstacles.Move(obstacles.Add(Board()), above);
  EXPECT_NEAR(obstacles.TopAt(3, -1, kClimb_m)->z_m, 0.6, 1e-12);
}

TEST(LowObstacles, ATiltedBoxIsARamp) {
  LowObstacles obstacles;
  RigidObstacle ramp = Board();
  ramp.boxes[0].X_BG = MakePose(Vec3(0, 0, 0.1), 0, -10 * kDeg, 0);
  BodyState carrier;
  carrier.X_WB = MakePose(Vec3(1, 2, 0));
  obstacles.Move(obstacles.Add(ramp), carrier);
  // Its upper face passes 0.05 / cos 10 deg above the centre and rises by tan 10 deg along x.
  for (const double x_m : {-0.5, 0.0, 0.7}) {
    EXPECT_NEAR(obstacles.TopAt(1 + x_m, 2.3, kClimb_m)->z_m,
                0.1 + 0.05 / std::cos(10 * kDeg) + x_m * std::tan(10 * kDeg), 1e-12);
  }
}

TEST(LowObstacles, TheWayOutIsTheShortestButNeverDown) {
  LowObstacles obstacles;
  obstacles.Move(obstacles.Add(Board()), Carrier());
  const auto up = obstacles.ExitFrom(Vec3(3, -1, 0.46), kClimb_m);
  ASSERT_TRUE(up);
  EXPECT_NEAR(up->way.depth_m, 0.09, 1e-12);
  EXPECT_NEAR((up->way.direction_W - Vec3::UnitZ()).norm(), 0, 1e-12);
  const auto out = obstacles.ExitFrom(Vec3(2.53, -1, 0.5), kClimb_m);
  ASSERT_TRUE(out);
  EXPECT_NEAR(out->way.depth_m, 0.03, 1e-12);
  EXPECT_NEAR((out->way.direction_W + Vec3::UnitX()).norm(), 0, 1e-12);
  EXPECT_NEAR((out->v_W_mps - Vec3(0.3, 0.1 - 0.47 * 0.5, 0)).norm(), 0, 1e-12);
  EXPECT_FALSE(obstacles.ExitFrom(Vec3(2.49, -1, 0.5), kClimb_m));
  EXPECT_FALSE(obstacles.ExitFrom(Vec3(3, -1, 0.44), kClimb_m));
}

}  // namespace
}  // namespace tera
