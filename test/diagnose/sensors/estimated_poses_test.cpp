#include "diagnose/sensors/estimated_poses.h"

#include <gtest/gtest.h>

#include "diagnose/sensors/made_recording.h"

namespace tera {
namespace {

SensorDiagnosis Estimated(MadeRecording* made) {
  StageClock clock;
  return DiagnoseSensors(made->Input(), made->measured, {}, &clock);
}

// Receivers of 8 mm of noise, five times a second, and two units.
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

TEST(EstimatedPoses, AreNotThereWhereNoReceiverTellsThePlace) {
  MadeRecording made({.seed = 31, .has_poses = false});
  for (auto& samples : made.measured.gnss) samples.clear();
  EXPECT_TRUE(EstimatedPoses(Estimated(&made)).empty());
}

}  // namespace
}  // namespace tera
