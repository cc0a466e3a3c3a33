#include "blind/mujoco/hand/hand.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tera::blind::mujoco {
namespace {

const MachineNumbers& TwoTons() {
  static const MachineNumbers numbers =
      MachineNumbers::Read("examples/prove/excavator2t.yaml", "examples/prove/rig2t.yaml");
  return numbers;
}

TEST(Hand, AnEasedLeverHasItsMean) {
  double sum = 0;
  for (int k = 0; k < 4000; ++k) sum += Eased(0.001 * (k + 0.5), 4, 0.3) / 4000;
  EXPECT_NEAR(sum, 1 - 0.3, 1e-5);
  EXPECT_EQ(Eased(2, 4, 0.3), 1);
  EXPECT_NEAR(Eased(0.6, 4, 0.3), 0.5, 1e-12);
}

/// Distance and height of the bucket's pin from the boom's, and the bucket's slope.
Vec3 Pin(const PerAxis<double>& angle_rad) {
  const double boom_rad = angle_rad[kBoom], arm_rad = boom_rad + angle_rad[kArm];
  return {1.70 * std::cos(boom_rad) + 0.97 * std::cos(arm_rad),
          1.70 * std::sin(boom_rad) + 0.97 * std::sin(arm_rad), arm_rad + angle_rad[kBucket]};
}

TEST(Hand, GradingMovesTheBucketLevel) {
  PerAxis<double> angle_rad{};
  angle_rad[kBoom] = 0.4, angle_rad[kArm] = -1.9, angle_rad[kBucket] = -0.2;
  const Vec3 from = Pin(angle_rad);
  for (int k = 0; k < 2000; ++k) {  // two seconds at 0.3 m/s
    const PerAxis<double> levers = LevelLevers(TwoTons(), angle_rad, 0.3);
    for (std::size_t i = kBoom; i < kAxisCount; ++i) {
      angle_rad[i] += 0.001 * levers[i] * TwoTons().full_rate_radps[i];
    }
  }
  const Vec3 way = Pin(angle_rad) - from;
  EXPECT_NEAR(way.x(), 0.6, 0.002);
  EXPECT_NEAR(way.y(), 0, 0.002);
  EXPECT_NEAR(way.z(), 0, 1e-6);
}

/// A machine that follows its levers at once, on a plane.
Instant Moved(const Instant& before, const PerAxis<double>& levers, double step_s) {
  Instant at = before;
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    at.rate_radps[i] = levers[i] * TwoTons().full_rate_radps[i];
    at.angle_rad[i] += step_s * at.rate_radps[i];
  }
  const double left_mps = TwoTons().radius_m * at.rate_radps[kLeftTrack];
  const double right_mps = TwoTons().radius_m * at.rate_radps[kRightTrack];
  at.p_WB_m += step_s * (left_mps + right_mps) / 2 * (before.q_WB * Vec3::UnitX());
  const double turned_rad = step_s * (right_mps - left_mps) / TwoTons().gauge_m;
  at.q_WB = before.q_WB * Quat(Eigen::AngleAxisd(turned_rad, Vec3::UnitZ()));
  return at;
}

TEST(Hand, KeepsOffStopsAndNearHomeWhateverItDoes) {
  for (const bool reserve : {false, true}) {
    Habit habit;
    habit.joints = {kSlew, kBoom, kArm, kBucket};
    for (const bool tracks : {false, true}) {
      const auto kinds = ManoeuvresOf(tracks, reserve);
      EXPECT_GE(kinds.size(), 3u);
      habit.kinds.insert(habit.kinds.end(), kinds.begin(), kinds.end());
    }
    Hand hand(TwoTons(), habit, Stream(3, "hand"));
    Instant at;
    at.p_WB_m = Vec3::Zero();
    at.q_WB = Quat::Identity();
    at.angle_rad = {0, 0, 0, 0.2, -1.5, -0.3};
    PerAxis<double> used{}, largest_rad = at.angle_rad, smallest_rad = at.angle_rad;
    for (int k = 0; k < 60000; ++k) {  // twenty minutes
      const PerAxis<double> levers = hand(0.02 * k, at);
      at = Moved(at, levers, 0.02);
      for (std::size_t i = 0; i < kAxisCount; ++i) {
        used[i] = std::max(used[i], std::abs(levers[i]));
        largest_rad[i] = std::max(largest_rad[i], at.angle_rad[i]);
        smallest_rad[i] = std::min(smallest_rad[i], at.angle_rad[i]);
      }
      ASSERT_LT(at.p_WB_m.norm(), 24) << 0.02 * k;
    }
    for (std::size_t i = kBoom; i < kAxisCount; ++i) {
      const JointNumbers& joint = TwoTons().joints[i];
      EXPECT_LT(largest_rad[i], joint.upper_rad) << kAxisNames[i];
      EXPECT_GT(smallest_rad[i], joint.lower_rad) << kAxisNames[i];
      EXPECT_GT(largest_rad[i] - smallest_rad[i], 0.4 * (joint.upper_rad - joint.lower_rad));
    }
    for (const double lever : used) EXPECT_GT(lever, 0.6);
  }
}

}  // namespace
}  // namespace tera::blind::mujoco
