#include "soil/tool/shovel_walls.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "soil/soil_fixture.h"

namespace tera {
namespace {

using namespace testing_soil;

/// A smooth box 2 m long, 0.5 m high and 0.6 m wide, whose mouth looks ahead.
Shovel Box() {
  Shovel box;
  box.profile_B_m = {{2, 0}, {0, 0}, {0, 0.5}, {2, 0.5}};
  box.width_m = 0.6;
  box.capacity_m3 = 0.6;
  return box;
}

constexpr double kShovelWallsYaw_rad = 0.4;
constexpr double kShovelWallsLong_s = 1e3;  ///< of travel at any speed: the soil has failed
constexpr double kGround_m = 2.0;
const Vec3 kShovelWallsAhead_W(std::cos(kShovelWallsYaw_rad), std::sin(kShovelWallsYaw_rad), 0);
const Vec3 kLeft_W(-std::sin(kShovelWallsYaw_rad), std::cos(kShovelWallsYaw_rad), 0);

/// Force on a shovel whose origin lies `depth_m` below level ground, once soil has failed.
Vec3 Force_n(const Shovel& shovel, const SoilType& soil, double depth_m, const Vec3& v_W_mps,
             double pitch_rad = 0) {
  Columns ground = LevelColumns(soil, 0.1, 101, kGround_m);
  ShovelWalls walls(shovel, {soil});
  BodyState body;
  body.X_WB = MakePose(Vec3(-1.0, -0.3, kGround_m - depth_m),
                       RotationFromRpy(0, pitch_rad, kShovelWallsYaw_rad));
  body.v_WB_mps = v_W_mps;
  return walls.Act(ShovelShape(shovel), body, kShovelWallsLong_s, {soil}, &ground).force_W_n;
}

TEST(ShovelWalls, ASideWallPushedSidewaysMeetsRankinesPassivePressure) {
  // K_p = 3 at 30 deg, over 2 m; shear on the two ends of the wedge adds up to a tenth.
  const double force_n = 3 * 1500 * 9.81 * 0.4 * 0.4 / 2 * 2;
  for (const double side : {-1.0, 1.0}) {
    const Vec3 v_W = side * 1e-3 * kLeft_W;
    EXPECT_NEAR(Force_n(Box(), SandOf30Deg(), 0.4, v_W).dot(-side * kLeft_W) / force_n, 1.05, 0.05);
  }
  // 0.3 m below the surface it meets that much less.
  const double buried_n = 3 * 1500 * 9.81 * (0.8 * 0.8 - 0.3 * 0.3) / 2 * 2;
  EXPECT_NEAR(Force_n(Box(), SandOf30Deg(), 0.8, 1e-3 * kLeft_W).dot(-kLeft_W) / buried_n, 1.1,
              0.1);
  EXPECT_EQ(Force_n(Box(), SandOf30Deg(), -0.001, 1e-3 * kLeft_W), Vec3::Zero());
}

TEST(ShovelWalls, TheBackPushesSoilBehindItAndIsNotHeldFromBehind) {
  const double force_n = 3 * 1500 * 9.81 * 0.4 * 0.4 / 2 * 0.6;  // over the width
  // A narrow wedge: the shear on its ends is a third of that.
  EXPECT_NEAR(
      Force_n(Box(), SandOf30Deg(), 0.4, -1e-3 * kShovelWallsAhead_W).dot(kShovelWallsAhead_W) /
          force_n,
      1.2, 0.2);
  Shovel blade = Box();  // without a rim
  blade.capacity_m3 = 0;
  EXPECT_LT(Force_n(blade, SandOf30Deg(), 0.4, 1e-3 * kShovelWallsAhead_W).norm(), 1e-6);
}

TEST(ShovelWalls, TheRimOfAMouthThatLooksDownIsPushedInLikeAThinEdge) {
  // At a pitch of 90 deg the box stands on its mouth, 2 m below its origin. The edges of the side
  // walls and the top edge are together 1.6 m long and 12 mm thick. At 0.5 m they bear as
  // Terzaghi's strip for local shear: rho g (0.5 N_q + 0.012 N_gamma / 2). phi is atan(2/3 tan 30
  // deg) = 21.05 deg, N_q = 7.1 and N_gamma = 6.2.
  const double full_n = 1500 * 9.81 * (0.5 * 7.1 + 0.006 * 6.2) * 0.012 * 1.6;
  const Vec3 down_W(0, 0, -1e-3);
  const auto up_n = [&](double depth_m, const Vec3& v_W) {
    return Force_n(Box(), SandOf30Deg(), depth_m - 2, v_W, 90 * kDeg).z();
  };
  EXPECT_NEAR(up_n(0.5, down_W) / full_n, 1, 0.03);
  EXPECT_NEAR(up_n(0.25, down_W) / full_n, 0.55, 0.02);
  EXPECT_NEAR(up_n(1.0, down_W) / full_n, 1, 0.03);
  EXPECT_EQ(up_n(0.5, -down_W), 0);
  EXPECT_EQ(up_n(-0.01, down_W), 0);
}

TEST(ShovelWalls, NoMotionIsEverDrivenOn) {
  const Stream random(6, "test/twists");
  const Shovel bucket = CompactBucket();
  const ShovelShape shape(bucket);
  int resisted = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const auto uniform = [&](int lane, double low, double high) {
      return low + (high - low) * random.Uniform(trial, lane);
    };
    Columns ground = LevelColumns(SandOf30Deg(), 0.05, 101, kGround_m);
    ShovelWalls walls(bucket, {SandOf30Deg()});
    BodyState body;
    body.X_WB =
        MakePose(Vec3(0, 0, kGround_m + uniform(0, -1.0, 0.7)),
                 RotationFromRpy(uniform(1, -0.5, 0.5), uniform(2, -3, 3), uniform(3, -3, 3)));
    const auto act = [&](double dt_s) {
      return walls.Act(shape, body, dt_s, {SandOf30Deg()}, &ground);
    };
    body.v_WB_mps = Vec3(uniform(4, -2, 2), uniform(5, -2, 2), uniform(6, -2, 2));
    body.w_WB_radps = Vec3(uniform(7, -2, 2), uniform(8, -2, 2), uniform(9, -2, 2));
    act(0.01);
    // Another way, with the walls' springs loaded.
    body.v_WB_mps = Vec3(uniform(10, -2, 2), uniform(11, -2, 2), uniform(12, -2, 2));
    const Wrench wrench = act(1e-5);
    const double power_w =
        wrench.force_W_n.dot(body.v_WB_mps) + wrench.torque_W_nm.dot(body.w_WB_radps);
    ASSERT_TRUE(std::isfinite(power_w)) << trial;
    ASSERT_LT(power_w, 1e-6) << trial;
    resisted += power_w < -1;
  }
  EXPECT_GT(resisted, 300);
}

}  // namespace
}  // namespace tera
