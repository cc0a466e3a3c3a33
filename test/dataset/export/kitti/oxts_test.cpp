#include "dataset/export/kitti/oxts.h"

#include <gtest/gtest.h>

#include <sstream>

#include "core/units.h"

namespace tera {
namespace {

std::vector<double> NumbersOf(const std::string& row) {
  std::istringstream text(row);
  std::vector<double> numbers;
  for (double number; text >> number;) numbers.push_back(number);
  return numbers;
}

/// North by 2 t + 1.5 t^2, 30 deg down, looking north, without turning.
SensorPoses Accelerating() {
  SensorPoses poses;
  for (int k = 0; k <= 200; ++k) {
    const double t_s = 0.01 * k;
    poses.Append(FromSeconds(t_s),
                 MakePose(Vec3(0, 2 * t_s + 1.5 * t_s * t_s, 0), 0, 30 * kDeg, 90 * kDeg));
  }
  return poses;
}

// Order and signs of KITTI's dataformat.txt: yaw 0 is east, pitch is positive with the front down.
TEST(Oxts, ABodyThatSpeedsUpNorthwardsTellsSo) {
  const auto row = NumbersOf(OxtsRow(MotionAt(Accelerating(), Pose::Identity(), kNsPerSecond), {}));
  ASSERT_EQ(row.size(), 30u);
  EXPECT_NEAR(row[3], 0, 1e-9);            // roll
  EXPECT_NEAR(row[4], 30 * kDeg, 1e-9);    // pitch
  EXPECT_NEAR(row[5], 90 * kDeg, 1e-9);    // yaw
  EXPECT_NEAR(row[6], 5, 1e-6);            // north
  EXPECT_NEAR(row[7], 0, 1e-6);            // east
  EXPECT_NEAR(row[8], 5, 1e-6);            // forward
  EXPECT_NEAR(row[10], 0, 1e-6);           // up
  EXPECT_NEAR(row[11], -2.3052488, 1e-5);  // 3 cos 30 - 9.80665 sin 30
  EXPECT_NEAR(row[13], 9.9928080, 1e-5);   // 3 sin 30 + 9.80665 cos 30
  EXPECT_NEAR(row[14], 3, 1e-5);           // forward, level
  EXPECT_NEAR(row[16], 9.80665, 1e-5);     // up
  for (int k = 17; k < 23; ++k) EXPECT_NEAR(row[k], 0, 1e-9) << k;
}

TEST(Oxts, TheEndsOfARecordingAreNoSlower) {
  const SensorPoses poses = Accelerating();
  EXPECT_NEAR(MotionAt(poses, Pose::Identity(), 0).v_W_mps.y(), 2, 1e-6);
  EXPECT_NEAR(MotionAt(poses, Pose::Identity(), 2 * kNsPerSecond).v_W_mps.y(), 8, 1e-6);
}

TEST(Oxts, ATurningSensorsBodyHasTheVelocityOfItsOwnOrigin) {
  SensorPoses poses;  // turns about W's z by 0.5 rad/s, rolled onto its left side
  for (int k = 0; k <= 100; ++k) {
    poses.Append(FromSeconds(0.01 * k), MakePose(Vec3::Zero(), -90 * kDeg, 0, 0.5 * 0.01 * k));
  }
  const Pose X_SB = MakePose(Vec3(2, 0, 0));
  const BodyMotion motion = MotionAt(poses, X_SB, 0);
  EXPECT_TRUE(motion.w_B_radps.isApprox(Vec3(0, -0.5, 0), 1e-6)) << motion.w_B_radps;
  const BodyMotion middle = MotionAt(poses, X_SB, 500'000'000);
  EXPECT_NEAR(middle.v_W_mps.norm(), 1, 1e-4);     // 0.5 rad/s at 2 m
  EXPECT_NEAR(middle.a_W_mps2.norm(), 0.5, 1e-3);  // towards the axis
}

TEST(Oxts, ASinglePoseStandsStill) {
  SensorPoses poses;
  poses.Append(0, MakePose(Vec3(1, 2, 3)));
  EXPECT_EQ(MotionAt(poses, Pose::Identity(), 0).v_W_mps, Vec3::Zero());
}

}  // namespace
}  // namespace tera
