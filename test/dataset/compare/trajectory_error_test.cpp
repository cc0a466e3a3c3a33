#include "dataset/compare/trajectory_error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/faults.h"
#include "core/units.h"

namespace tera {
namespace {

using enum FaultKind;
constexpr double kTight = 1e-9;

TimeNs At(int k) { return k * (kNsPerSecond / 10); }

/// A climbing spiral that is not symmetric in any axis, 5 s at 10 Hz.
Trajectory Spiral() {
  Trajectory track;
  for (int k = 0; k <= 50; ++k) {
    const double s = 0.1 * k;
    track.push_back({At(k), MakePose(Vec3(s * std::cos(s), 2 + s * std::sin(s), 0.3 * s * s),
                                     0.02 * s, -0.03 * s, s + 0.5)});
  }
  return track;
}

Trajectory Moved(const Pose& X_VW, const Trajectory& track) {
  Trajectory moved = track;
  for (TimedPose& pose : moved) pose.X_WB = X_VW * pose.X_WB;
  return moved;
}

TEST(TrajectoryError, OfAShiftIsItsLengthAndHasNoRelativePart) {
  const Trajectory b = Moved(MakePose(Vec3(0.3, -0.4, 1.2)), Spiral());
  const TrajectoryError e = EvaluateTrajectory(Spiral(), b, {});
  EXPECT_NEAR(e.ape_translation_m.rmse, 1.3, kTight);
  EXPECT_NEAR(e.ape_translation_m.mean, 1.3, kTight);
  EXPECT_NEAR(e.ape_translation_m.median, 1.3, kTight);
  EXPECT_NEAR(e.ape_translation_m.max, 1.3, kTight);
  EXPECT_NEAR(e.ape_rotation_rad.max, 0, kTight);
  EXPECT_NEAR(e.rpe_translation_m.max, 0, kTight);
  EXPECT_NEAR(e.final_drift_m, 0, kTight);
  EXPECT_EQ(e.ape.size(), 51u);
  EXPECT_EQ(e.rpe_count, 41u);
}

TEST(TrajectoryError, OfAFixedTiltOfTheBodyIsItsAngle) {
  Trajectory b = Spiral();
  const Pose tilt = MakePose(Vec3::Zero(), 0, 5 * kDeg, 0);
  for (TimedPose& pose : b) pose.X_WB = pose.X_WB * tilt;
  const TrajectoryError e = EvaluateTrajectory(Spiral(), b, {});
  EXPECT_NEAR(e.ape_rotation_rad.rmse, 5 * kDeg, kTight);
  EXPECT_NEAR(e.ape_translation_m.max, 0, kTight);
}

TEST(TrajectoryError, OfAStraightRunThatIsOnePercentShort) {
  // Along x at 2 m/s for 10 s against 1.98 m/s. Absolute error grows from 0 to 0.2 m evenly; over
  // each second 0.02 m are lost; lengths are 20 m and 19.8 m.
  Trajectory a, b;
  for (int k = 0; k <= 100; ++k) {
    a.push_back({At(k), MakePose(Vec3(5 + 0.2 * k, -1, 0), 0, 0, 30 * kDeg)});
    b.push_back({At(k), MakePose(Vec3(5 + 0.198 * k, -1, 0), 0, 0, 30 * kDeg)});
  }
  const TrajectoryError e = EvaluateTrajectory(a, b, {});
  EXPECT_NEAR(e.ape_translation_m.mean, 0.1, kTight);
  EXPECT_NEAR(e.ape_translation_m.median, 0.1, kTight);
  EXPECT_NEAR(e.ape_translation_m.max, 0.2, kTight);
  // Sum of squares 0..100 is 338350: 0.002 sqrt(338350 / 101).
  EXPECT_NEAR(e.ape_translation_m.rmse, 0.002 * std::sqrt(338350.0 / 101.0), kTight);
  EXPECT_NEAR(e.rpe_translation_m.rmse, 0.02, kTight);
  EXPECT_NEAR(e.path_length_a_m, 20, kTight);
  EXPECT_NEAR(e.path_length_b_m, 19.8, kTight);
  EXPECT_NEAR(e.final_drift_m, 0.2, kTight);
}

TEST(TrajectoryError, OfAGyroDriftIsTheTurnOverEachIntervalAndAtTheEnd) {
  // Turning on the spot; b turns 1 deg/s too fast for 5 s.
  Trajectory a, b;
  for (int k = 0; k <= 50; ++k) {
    a.push_back({At(k), MakePose(Vec3(1, 2, 3), 0, 0, 0.1 * k)});
    b.push_back({At(k), MakePose(Vec3(1, 2, 3), 0, 0, 0.1 * k + 0.1 * k * kDeg)});
  }
  const TrajectoryError e = EvaluateTrajectory(a, b, {});
  EXPECT_NEAR(e.rpe_rotation_rad.mean, 1 * kDeg, kTight);
  EXPECT_NEAR(e.rpe_rotation_rad.max, 1 * kDeg, kTight);
  EXPECT_NEAR(e.final_drift_rad, 5 * kDeg, kTight);
}

TEST(TrajectoryError, Se3AlignmentFindsTheMotionBetweenTheWorlds) {
  const Pose X_WV = MakePose(Vec3(10, -20, 3), 0.4, -0.7, 2.5);
  TrajectoryErrorOptions options;
  options.alignment = Alignment::kSe3;
  const TrajectoryError e = EvaluateTrajectory(Spiral(), Moved(X_WV.inverse(), Spiral()), options);
  EXPECT_TRUE(e.X_WV.isApprox(X_WV, kTight));
  EXPECT_NEAR(e.ape_translation_m.max, 0, kTight);
  EXPECT_NEAR(e.ape_rotation_rad.max, 0, 1e-7);
}

TEST(TrajectoryError, Se2AlignmentFindsYawAndShiftAndLeavesTheHeight) {
  const Pose X_WV = MakePose(Vec3(10, -20, 0), 0, 0, 2.5);
  const Pose lift = MakePose(Vec3(0, 0, 0.5));
  TrajectoryErrorOptions options;
  options.alignment = Alignment::kSe2;
  const TrajectoryError e =
      EvaluateTrajectory(Spiral(), Moved(lift * X_WV.inverse(), Spiral()), options);
  EXPECT_TRUE(e.X_WV.isApprox(X_WV, kTight));
  EXPECT_NEAR(e.ape_translation_m.mean, 0.5, kTight);
  EXPECT_NEAR(e.ape_rotation_rad.max, 0, 1e-7);
}

TEST(TrajectoryError, InterpolatesBetweenSamplesAtOtherTimes) {
  Trajectory a, b;  // the same straight run, b sampled at odd times and starting later
  for (int k = 0; k <= 20; ++k) a.push_back({At(k), MakePose(Vec3(0.5 * k, 1, 0))});
  for (int k = 3; k <= 17; ++k) {
    b.push_back({At(k) + 37'000'000, MakePose(Vec3(0.5 * (k + 0.37), 1, 0))});
  }
  const TrajectoryError e = EvaluateTrajectory(a, b, {});
  EXPECT_EQ(e.ape.size(), 14u);  // 0.4 s to 1.7 s
  EXPECT_NEAR(e.ape_translation_m.max, 0, kTight);
}

TEST(TrajectoryError, DoesNotInterpolateAcrossGaps) {
  Trajectory b = Spiral();
  b.erase(b.begin() + 10, b.begin() + 30);  // 2.1 s
  EXPECT_EQ(EvaluateTrajectory(Spiral(), b, {}).ape.size(), 31u);
}

TEST(TrajectoryError, NeedsTimesInCommon) {
  Trajectory late = Spiral();
  for (TimedPose& pose : late) pose.t_ns += 100 * kNsPerSecond;
  EXPECT_THAT([&] { EvaluateTrajectory(Spiral(), late, {}); }, ThrowsFault(kOutOfRange));
}

}  // namespace
}  // namespace tera
