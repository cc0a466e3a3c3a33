#include "physics/actuation/kinematic_gain.h"

#include <gtest/gtest.h>

#include <cmath>

#include "physics/actuation/slot_fixture.h"

namespace tera {
namespace {

constexpr double kKinematicGainStep_s = 0.002;

KinematicGain GainFrom(const std::string& yaml) {
  return KinematicGain(KinematicGainOf(EffectsFrom(yaml)));
}

TEST(KinematicGain, WithoutEffectsIsThePassThrough) {
  KinematicGain gain = GainFrom("{}");
  for (int i = 0; i < 100; ++i)
    EXPECT_EQ(gain.Step(std::sin(i), i, kKinematicGainStep_s), std::sin(i));
}

TEST(KinematicGain, ACylinderMovesItsJointSoThatItsLengthGrowsSteadily) {
  // Pins at 0.4 and 1.1 m from the joint, 40 deg apart at q = 0. With a constant gain the length by
  // the law of cosines grows at a constant rate, at any angle.
  KinematicGain gain = GainFrom(
      "cylinder_lever: {barrel_m: 0.4, rod_m: 1.1, angle_at_zero_rad: 0.6981317, "
      "reference_rad: 0.5}");
  const auto length_m = [](double q_rad) {
    return std::sqrt(0.16 + 1.21 - 0.88 * std::cos(0.6981317 + q_rad));
  };
  EXPECT_NEAR(gain.Step(0.3, 0.5, kKinematicGainStep_s), 0.3, 1e-12);
  double q_rad = -0.3;
  const double first_m = length_m(q_rad);
  const int steps = 4000;
  for (int i = 0; i < steps; ++i) {
    // Heun's rule, so that the integration is exact enough.
    const double here = gain.Step(0.3, q_rad, 1e-3);
    q_rad += 0.5e-3 * (here + gain.Step(0.3, q_rad + 1e-3 * here, 1e-3));
  }
  const double h = 1e-6, arm_m = (length_m(0.5 + h) - length_m(0.5 - h)) / (2 * h);
  EXPECT_NEAR(length_m(q_rad) - first_m, 0.3 * arm_m * steps * 1e-3, 1e-6);
}

TEST(KinematicGain, ADeadCentreDoesNotBlowUp) {
  const KinematicGain gain = GainFrom(
      "cylinder_lever: {barrel_m: 0.4, rod_m: 1.1, angle_at_zero_rad: -0.5, reference_rad: -0.3}");
  EXPECT_LE(gain.Gain(0.5), 10);  // both pins in one line
  EXPECT_GT(gain.Gain(0.5), 1);
}

TEST(KinematicGain, BacklashTakesTheGapOfEveryReversal) {
  // A triangle of 0.2 rad up and down; after a gap of 0.03 rad it is 0.03 rad smaller.
  KinematicGain gain = GainFrom("backlash: {gap_rad: 0.03}");
  double before_rad = 0, behind_rad = 0, lowest_rad = 1, highest_rad = 0;
  for (int i = 0; i < 4000; ++i) {
    const double rate = (i / 500) % 2 == 0 ? 0.2 : -0.2;
    before_rad += rate * kKinematicGainStep_s;
    const double moved = gain.Step(rate, before_rad, kKinematicGainStep_s);
    behind_rad += moved * kKinematicGainStep_s;
    // The play operator never lets the two sides leave the gap.
    EXPECT_LE(std::abs(behind_rad - before_rad), 0.015 + 1e-9);
    if (i < 1000) continue;
    lowest_rad = std::min(lowest_rad, behind_rad);
    highest_rad = std::max(highest_rad, behind_rad);
  }
  EXPECT_NEAR(highest_rad, 0.185, 1e-9);
  EXPECT_NEAR(highest_rad - lowest_rad, 0.2 - 0.03, 1e-9);
}

}  // namespace
}  // namespace tera
