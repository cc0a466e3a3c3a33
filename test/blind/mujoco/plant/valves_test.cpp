#include "blind/mujoco/plant/valves.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tera::blind::mujoco {
namespace {

TEST(Valves, ASoftStartIsFlatAtItsThresholdAndLacksBothFarBeyond) {
  EXPECT_EQ(SoftStart(0.099, 0.1, 0.05), 0);
  EXPECT_EQ(SoftStart(-0.099, 0.1, 0.05), 0);
  // Initially of second order: s^2 / (2 soft).
  EXPECT_NEAR(SoftStart(0.102, 0.1, 0.05), 0.002 * 0.002 / 0.1, 1e-6);
  EXPECT_NEAR(SoftStart(1, 0.1, 0.05), 1 - 0.15, 1e-6);
  EXPECT_NEAR(SoftStart(-0.6, 0.1, 0.05), -0.45, 1e-5);
}

TEST(Valves, OfLoadsACounterbalanceValvePassesOnThoseAgainstTheMotion) {
  EXPECT_NEAR(Counterbalance(0.3, 0.5, 0.8), 0.85, 1e-12);    // lifts half the rated load
  EXPECT_NEAR(Counterbalance(0.3, 0.5, -0.8), 1, 1e-12);      // lowers it
  EXPECT_NEAR(Counterbalance(0.3, -0.5, -0.8), 0.85, 1e-12);  // a hanging arm is drawn in
}

TEST(Valves, OilOfTheRodHelpsInwardsWithoutLoad) {
  EXPECT_EQ(Regeneration(0.4, 0, 0.5), 1);
  EXPECT_NEAR(Regeneration(0.4, 0, -0.5), 1.4, 1e-12);
  EXPECT_NEAR(Regeneration(0.4, 0.9, -0.5), 1.4, 1e-12);  // falls
  EXPECT_NEAR(Regeneration(0.4, -0.9, -0.5), 1, 1e-12);   // digs
  EXPECT_LT(Regeneration(0.4, -0.25, -0.5), 1.4);
  EXPECT_GT(Regeneration(0.4, -0.25, -0.5), 1);
}

TEST(Valves, WhatFellAheadOfItsOilWaitsForAsMuch) {
  RunsAhead arm(0.4);
  double way = 0, waits_s = 0;
  for (int k = 0; k < 2000; ++k) {  // a second of falling, then the load reverses
    const double rate = arm.Rate(-0.5, k < 1000 ? 0.3 : -0.3, 0.001);
    way += 0.001 * rate;
    waits_s += rate == 0 ? 0.001 : 0;
  }
  // Ahead by 0.4 of a second's path, which the pump compensates in 0.4 s: the total is unchanged.
  EXPECT_NEAR(waits_s, 0.4, 0.002);
  EXPECT_NEAR(way, -0.5 * 2, 0.002);
  arm.Rate(-0.5, 0.3, 0.001);
  EXPECT_EQ(arm.Rate(0.5, 0.3, 0.001), 0.5);     // outwards nothing waits,
  EXPECT_EQ(arm.Rate(-0.5, -0.3, 0.001), -0.5);  // and nothing is left of it
}

TEST(Valves, ABrakeOpensLateAfterASecondAtRest) {
  HoldingBrake brake(0.3);
  double held_s[3] = {};
  double t_s = 0;
  const double rests_s[] = {5, 0.9, 1.1};
  for (int n = 0; n < 3; ++n) {
    for (const double end_s = t_s + rests_s[n]; t_s < end_s; t_s += 0.001) brake.Share(t_s, 0);
    for (const double end_s = t_s + 2; t_s < end_s; t_s += 0.001) {
      held_s[n] += brake.Share(t_s, 0.2) == 0 ? 0.001 : 0;
    }
  }
  EXPECT_NEAR(held_s[0], 0.3, 0.002);
  EXPECT_EQ(held_s[1], 0);
  EXPECT_NEAR(held_s[2], 0.3, 0.002);
}

}  // namespace
}  // namespace tera::blind::mujoco
