#include "soil/flow/grains.h"

#include <gtest/gtest.h>

#include <cmath>

#include "soil/soil_fixture.h"

namespace tera {
namespace {

using testing_soil::kStep_s;
using testing_soil::LevelColumns;

SoilType GrainsSand() {
  SoilType sand;
  sand.bank_density_kgpm3 = 1500;
  sand.max_density_kgpm3 = 1800;
  sand.swell = 1.1;
  sand.repose_angle_rad = 32 * kDeg;
  return sand;
}

SpoilMix OneClod() {
  SpoilMix spoil;
  spoil.Add({0.13, 1e-4, 0, 0});
  return spoil;
}

/// Where the ground gained mass, weighted by it.
Vec2 CentreOfGain(const Columns& ground) {
  Vec2 sum = Vec2::Zero();
  double total = 0;
  for (int j = 0; j < ground.ny(); ++j) {
    for (int i = 0; i < ground.nx(); ++i) {
      sum += ground.TopAt(i, j) * Vec2(ground.x_m(i), ground.y_m(j));
      total += ground.TopAt(i, j);
    }
  }
  return sum / total;
}

TEST(Grains, AClodFallsAsGalileoSaysAndSlidesAsFarAsFrictionLetsIt) {
  Columns ground = LevelColumns(GrainsSand(), 0.05, 201);
  Grains grains({GrainsSand()}, 1);
  // Many at once: their scatter of 0.15 m/s averages out.
  SpoilMix spoil;
  spoil.Add({13, 0.01, 0, 0});
  grains.Pour(spoil, Vec3(-2, 0, 1), Vec3(-2, 0, 1), Vec3(2, 0, 0), &ground);
  const double fall_s = std::sqrt(2 * 1.0 / kStandardGravity_mps2);
  int steps = 0;
  for (; grains.count() > 0 && steps < 5000; ++steps) grains.Step(kStep_s, &ground);
  EXPECT_NEAR(ground.GroundGain().net_kg, 13, 1e-9);
  // It lands 2 m/s x fall time further on; the impact of 4.43 m/s takes all of 2 m/s (mu = 0.62).
  EXPECT_NEAR(CentreOfGain(ground).x(), -2 + 2 * fall_s, 0.05);
  EXPECT_GT(steps * kStep_s, 0.9 * fall_s);
}

TEST(Grains, ASlidingClodStopsAfterItsBrakingDistance) {
  Columns ground = LevelColumns(GrainsSand(), 0.05, 201);
  Grains grains({GrainsSand()}, 1);
  SpoilMix spoil;
  spoil.Add({13, 0.01, 0, 0});
  grains.Pour(spoil, Vec3(-2, 0, 0), Vec3(-2, 0, 0), Vec3(3, 0, 0), &ground);
  for (int k = 0; grains.count() > 0 && k < 5000; ++k) grains.Step(kStep_s, &ground);
  const double braking_m = 9 / (2 * std::tan(32 * kDeg) * kStandardGravity_mps2);
  EXPECT_NEAR(CentreOfGain(ground).x(), -2 + braking_m, 0.12 * braking_m);
}

TEST(Grains, OnASlopeSteeperThanFrictionTheyGoDownAndOnAGentlerOneTheyStay) {
  for (const double slope_deg : {25.0, 40.0}) {
    UndisturbedGround plan;
    plan.grid = {.origin_W_m = Vec2(-5, -5), .cell_m = 0.05, .nx = 201, .ny = 201};
    plan.base_cells = 50;
    for (int b = 0; b < 5; ++b) {
      for (int a = 0; a < 5; ++a)
        plan.base_height_m.push_back(2.5 * a * std::tan(slope_deg * kDeg));
    }
    plan.profiles.push_back(GroundProfile({{1e9, 0, 0, 1500}}));
    Columns ground(plan, {GrainsSand()});
    Grains grains({GrainsSand()}, 1);
    const Vec3 p(2, 0, ground.HeightAt(2, 0));
    grains.Pour(OneClod(), p, p, Vec3::Zero(), &ground);
    for (int k = 0; grains.count() > 0 && k < 5000; ++k) grains.Step(kStep_s, &ground);
    double x = 0;
    for (int i = 0; i < ground.nx(); ++i) {
      for (int j = 0; j < ground.ny(); ++j) {
        if (ground.surface().at(i, j).cover.looseness > 0) x = ground.x_m(i);
      }
    }
    if (slope_deg < 32) {
      EXPECT_NEAR(x, 2, 0.2);
    } else {
      EXPECT_LT(x, 0);
    }
  }
}

TEST(Grains, ThereAreNeverMoreThanTheMostAndNoMassIsLost) {
  Columns ground = LevelColumns(GrainsSand(), 0.05, 201);
  Grains grains({GrainsSand()}, 1);
  double poured_kg = 0;
  for (int k = 0; k < 100; ++k) {
    SpoilMix spoil;
    spoil.Add({1300, 1.0, 0, 0});
    poured_kg += 1300;
    grains.Pour(spoil, Vec3(-2, 0, 3), Vec3(2, 0, 3), Vec3::Zero(), &ground);
    if (k % 10 == 0) grains.Step(kStep_s, &ground);
    ASSERT_LE(grains.count(), Grains::kMostClods);
  }
  EXPECT_EQ(grains.count(), Grains::kMostClods);
  EXPECT_NEAR((ground.GroundGain().net_kg + grains.mass_kg()) / poured_kg, 1, 1e-12);
  while (grains.count() > 0) grains.Step(kStep_s, &ground);
  EXPECT_NEAR((ground.GroundGain().net_kg + ground.outside_kg()) / poured_kg, 1, 1e-12);
}

TEST(Grains, SoilOverTheBorderLeavesTheSite) {
  Columns ground = LevelColumns(GrainsSand(), 0.05, 41);
  Grains grains({GrainsSand()}, 1);
  grains.Pour(OneClod(), Vec3(5, 0, 1), Vec3(5, 0, 1), Vec3::Zero(), &ground);
  for (int k = 0; k < 2000; ++k) grains.Step(kStep_s, &ground);
  EXPECT_EQ(ground.GroundGain().net_kg, 0);
  EXPECT_NEAR(ground.outside_kg(), 0.13, 1e-12);
}

}  // namespace
}  // namespace tera
