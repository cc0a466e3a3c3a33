#include "sim/operators/dead_zone_compensation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace tera {
namespace {

constexpr double kStep_s = 0.002;

/// A joint whose valve opens beyond `zone` of the lever, in proportion to the excess. The rate, 1
/// rad/s at 1, follows within 50 ms. The controller commands 2/s of the remaining error.
struct Valve {
  double zone = 0;
  double q_rad = 0, rate_radps = 0;
  DeadZoneCompensation compensation = DeadZoneCompensation();

  /// Time until the target is within `near_rad`, or 60 s.
  double Reach(double target_rad, double near_rad) {
    for (double t_s = 0; t_s < 60; t_s += kStep_s) {
      const double left_rad = target_rad - q_rad;
      if (std::abs(left_rad) < near_rad) return t_s;
      const double wanted = std::clamp(2 * left_rad, -1.0, 1.0);
      Move(compensation.Lever(wanted, rate_radps, kStep_s));
    }
    return 60;
  }

  void Move(double lever) {
    const double open = std::copysign(std::max(0.0, std::abs(lever) - zone), lever);
    rate_radps += (open - rate_radps) * kStep_s / 0.05;
    q_rad += rate_radps * kStep_s;
  }
};

TEST(DeadZoneCompensation, LeavesTheLeverOfAJointThatFollows) {
  Valve valve;
  valve.Reach(0.7, 0.01);
  for (const double wanted : {0.9, 0.2, 0.02, -0.02, -0.4, -1.0}) {
    EXPECT_EQ(valve.compensation.Lever(wanted, wanted, kStep_s), wanted);
  }
}

TEST(DeadZoneCompensation, PushesUntilTheJointComesNearItsTarget) {
  // Without compensation, a joint stops where 2/s times the error equals the zone: 0.125 rad short
  // of the target.
  Valve valve{.zone = 0.25};
  const double first_s = valve.Reach(0.5, 0.03);
  EXPECT_LT(first_s, 4);
  valve.q_rad = valve.rate_radps = 0;
  EXPECT_LT(valve.Reach(0.5, 0.03), first_s - 0.4);  // the learnt width stays
}

TEST(DeadZoneCompensation, LearnsEachDirectionOnItsOwn) {
  Valve valve{.zone = 0.2};
  valve.Reach(0.5, 0.03);
  EXPECT_NEAR(valve.compensation.Lever(0.3, 0.3, kStep_s), 0.5, 0.1);
  EXPECT_EQ(valve.compensation.Lever(-0.3, -0.3, kStep_s), -0.3);
}

TEST(DeadZoneCompensation, GivesWayWhereTheZoneIsNarrowerThanLearnt) {
  Valve valve{.zone = 0.4};
  valve.Reach(0.5, 0.03);
  const double wide = valve.compensation.Lever(0.1, 0.1, kStep_s);
  for (int k = 0; k < 300; ++k) valve.compensation.Lever(0.1, 0.4, kStep_s);
  EXPECT_LT(valve.compensation.Lever(0.1, 0.1, kStep_s), wide - 0.2);
}

TEST(DeadZoneCompensation, DoesNotPushAJointThatItsLoadHolds) {
  DeadZoneCompensation compensation;
  for (int k = 0; k < 5000; ++k) EXPECT_EQ(compensation.Lever(0.6, 0, kStep_s), 0.6);
}

TEST(DeadZoneCompensation, NeverAsksForMoreThanFullLever) {
  DeadZoneCompensation compensation;
  for (int k = 0; k < 5000; ++k) compensation.Lever(0.4, 0, kStep_s);
  EXPECT_EQ(compensation.Lever(0.9, 0.9, kStep_s), 1.0);
  EXPECT_LE(compensation.Lever(0.4, 0.4, kStep_s), 0.9);
}

TEST(DeadZoneCompensation, LeavesAJointAloneThatReboundsIfItIsToldSo) {
  // A command of 0.3, then its negative for a second.
  DeadZoneCompensation gentle({.rebound_ratio = 0.15}), eager;
  for (double t_s = 0; t_s < 1; t_s += kStep_s) {
    EXPECT_EQ(gentle.Lever(0.3, -0.3, kStep_s), 0.3);
    eager.Lever(0.3, -0.3, kStep_s);
  }
  EXPECT_GT(eager.Lever(0.3, -0.3, kStep_s), 0.4);
}

TEST(DeadZoneCompensation, TheNarrowerTheTransitionTheNearerAJointComes) {
  double left_rad[2] = {};
  for (const bool narrow : {false, true}) {
    Valve valve{.zone = 0.15,
                .compensation = DeadZoneCompensation({.transition = narrow ? 0.015 : 0.05})};
    valve.Reach(0.5, 0);
    left_rad[narrow] = std::abs(0.5 - valve.q_rad);
  }
  EXPECT_LT(left_rad[true], 0.5 * left_rad[false]);
}

}  // namespace
}  // namespace tera
