#include "core/motion.h"

#include <gtest/gtest.h>

#include "core/units.h"

namespace tera {
namespace {

TEST(Rpy, FollowsTheUrdfOrder) {
  // Yaw 90 deg after pitch 90 deg: x goes down, whatever the yaw; y goes to -x.
  const Mat3 R = RotationFromRpy(0, 90 * kDeg, 90 * kDeg);
  EXPECT_TRUE((R * Vec3::UnitX()).isApprox(Vec3(0, 0, -1), 1e-12));
  EXPECT_TRUE((R * Vec3::UnitY()).isApprox(Vec3(-1, 0, 0), 1e-12));
}

TEST(Rpy, ComesBackFromTheRotation) {
  const Vec3 rpy(0.3, -1.1, 2.5);
  EXPECT_TRUE(RpyFromRotation(RotationFromRpy(0.3, -1.1, 2.5)).isApprox(rpy, 1e-12));
}

TEST(MotionOfFixedFrame, HasCentripetalAndTangentialAcceleration) {
  BodyState body;  // turning about z at 2 rad/s, speeding up at 3 rad/s^2, itself yawed by 90 deg
  body.X_WB = MakePose(Vec3(5, -2, 1), 0, 0, 90 * kDeg);
  body.w_WB_radps = Vec3(0, 0, 2);
  body.alpha_WB_radps2 = Vec3(0, 0, 3);
  const BodyState s = MotionOfFixedFrame(body, MakePose(Vec3(0.5, 0, 0)));
  EXPECT_TRUE(s.X_WB.translation().isApprox(Vec3(5, -1.5, 1), 1e-12));
  EXPECT_TRUE(s.v_WB_mps.isApprox(Vec3(-1, 0, 0), 1e-12));
  EXPECT_TRUE(s.a_WB_mps2.isApprox(Vec3(-1.5, -2, 0), 1e-12));
}

TEST(PoseTrack, InterpolatesBetweenSamplesAndHoldsItsEnds) {
  PoseTrack track;
  track.Append(100, MakePose(Vec3(1, 0, 0)));
  track.Append(200, MakePose(Vec3(3, 0, 0), 0, 0, 90 * kDeg));
  EXPECT_NEAR(track.At(150).translation().x(), 2.0, 1e-12);
  EXPECT_NEAR(RpyFromRotation(track.At(150).linear()).z(), 45 * kDeg, 1e-12);
  EXPECT_NEAR(track.At(0).translation().x(), 1.0, 1e-12);
  EXPECT_NEAR(track.At(900).translation().x(), 3.0, 1e-12);
}

TEST(PoseTrack, KeepsWhatLaterQueriesNeed) {
  PoseTrack track;
  for (int k = 0; k < 10; ++k) track.Append(10 * k, MakePose(Vec3(k, 0, 0)));
  track.DropBefore(45);
  EXPECT_NEAR(track.At(0).translation().x(), 4, 1e-12) << "the oldest that is left";
  EXPECT_NEAR(track.At(45).translation().x(), 4.5, 1e-12);
}

}  // namespace
}  // namespace tera
