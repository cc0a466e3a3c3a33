#include "diagnose/sensors/estimated_poses.h"

#include <gtest/gtest.h>

#include "diagnose/sensors/made_recording.h"

namespace tera {
namespace {

SensorDiagnosis Estimated(MadeRecording* made) {
  StageClock clock;
  return DiagnoseSensors(made->Input(), made->measured, {}, &clock);
}

// Receivers with 8 mm of noise at 5 Hz, and two units.
TEST(EstimatedPoses, FollowTheBaseWithoutRecordedOnes) {
  MadeRecording made({.seed = 31, .has_poses = false});
  const std::vector<TruthPose> poses = EstimatedPoses(Estimated(&made));
  ASSERT_GT(poses.size(), 380u) << "of 40 s, ten a second";
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_EQ(poses[i].t_ns - poses[0].t_ns, static_cast<TimeNs>(i) * 100'000'000);
    const Pose X_WB = made.Base(ToSeconds(poses[i].t_ns));
    EXPECT_LT((poses[i].X_WB.translation() - X_WB.translation()).norm(), 0.1) << i;
    const Mat3 turned = poses[i].X_WB.linear().transpose() * X_WB.linear();
    EXPECT_LT(Eigen::AngleAxisd(turned).angle(), 0.06) << i;
  }
}

// Two straight parts. The second begins 0.04 rad to the left of the first one's end, plus a whole
// turn.
TEST(EstimatedPoses, OfPartsThatDifferMeetBetweenThem) {
  SensorDiagnosis made;
  made.knows_base = true;
  for (int part = 0; part < 2; ++part) {
    EstimatedMotion motion;
    motion.spline = {.step_s = 0.5, .coefficients = 28};
    motion.start_ns = FromSeconds(10 * part);
    motion.end_ns = FromSeconds(10 * (part + 1));
    motion.spline_start_ns = motion.start_ns - FromSeconds(0.5);
    motion.coefficients = Eigen::MatrixXd::Zero(28, kBaseNumbers);
    motion.coefficients.col(kYaw).setConstant(part * (0.04 + 2 * kPi) + 0.3);
    made.motion.push_back(motion);
  }
  const std::vector<TruthPose> poses = EstimatedPoses(made);
  ASSERT_EQ(poses.size(), 201u);
  const auto yaw = [&](std::size_t k) { return RpyFromRotation(poses[k].X_WB.linear()).z(); };
  EXPECT_NEAR(yaw(0), 0.3, 1e-9);
  EXPECT_NEAR(yaw(50), 0.31, 1e-9);
  EXPECT_NEAR(yaw(100), 0.32, 1e-9);
  EXPECT_NEAR(yaw(150), 0.33, 1e-9);
  EXPECT_NEAR(yaw(200), 0.34, 1e-9);
}

TEST(EstimatedPoses, AreNotThereWhereNoReceiverTellsThePlace) {
  MadeRecording made({.seed = 31, .has_poses = false});
  for (auto& samples : made.measured.gnss) samples.clear();
  EXPECT_TRUE(EstimatedPoses(Estimated(&made)).empty());
}

}  // namespace
}  // namespace tera
