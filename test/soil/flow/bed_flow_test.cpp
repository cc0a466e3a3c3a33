#include "soil/flow/bed_flow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "soil/soil_fixture.h"

namespace tera {
namespace {

using testing_soil::kStep_s;
using testing_soil::LevelColumns;

/// Clods fall for less than a second and slide for three at most.
constexpr double kAtRest_s = 4;

SoilType Sand() {
  SoilType sand;
  sand.bank_density_kgpm3 = 1500;
  sand.max_density_kgpm3 = 1800;
  sand.swell = 1.2;
  sand.friction_angle_rad = 35 * kDeg;
  sand.repose_angle_rad = 32 * kDeg;
  return sand;
}

/// A bed 3 m x 2 m, its floor 1.2 m up, turned and away from W's origin, on level ground.
struct Yard {
  Yard() : ground(LevelColumns(Sand(), 0.05, 301)), avalanche({Sand()}), grains({Sand()}, 3) {
    grains.beds().emplace_back(SoilBed{Vec3(-0.5, 0, 1.2), Vec2(3, 2), wall_m},
                               std::vector<SoilType>{Sand()});
    bed().Move(X_WB);
  }
  Bed& bed() { return grains.beds().front(); }
  /// Lets soil fall to a place in the floor's frame, 1 m above the rim.
  void Pour(const Vec2& p_F, double volume_m3, double rate_m3ps = 0.1) {
    const double part_m3 = 0.01 * rate_m3ps;
    for (double left_m3 = volume_m3; left_m3 > 0; left_m3 -= part_m3) {
      SpoilMix spoil;
      spoil.Add({1250 * part_m3, part_m3, 0, 0});
      poured_kg += spoil.mass_kg();
      const Vec3 p_W = bed().X_WF() * Vec3(p_F.x(), p_F.y(), wall_m + 1);
      grains.Pour(spoil, p_W, p_W, Vec3::Zero(), &ground);
      Wait(0.01);
    }
    Wait(kAtRest_s);
  }
  void Wait(double time_s) {
    for (int k = 0; k < std::lround(time_s / kStep_s); ++k) {
      bed_flow.Flow(kStep_s, &bed(), &ground, &grains);
      grains.Step(kStep_s, &ground);
      avalanche.Flow(kStep_s, &ground, &grains);
    }
  }
  double Sum_kg() { return bed().mass_kg() + grains.mass_kg() + ground.GroundGain().net_kg; }

  const double wall_m = 0.6;
  const Pose X_WB = MakePose(Vec3(2, -1, 0.3), RotationFromRpy(0, 0, 35 * kDeg));
  Columns ground;
  Avalanche avalanche;
  BedFlow bed_flow{{Sand()}};
  Grains grains;
  double poured_kg = 0;
};

TEST(Bed, HoldsWhatIsPouredIntoItAtRepose) {
  Yard yard;
  yard.Pour(Vec2(0.3, 0.1), 0.2);
  EXPECT_NEAR(yard.bed().mass_kg() / yard.poured_kg, 1, 1e-12);
  EXPECT_EQ(yard.ground.GroundGain().gained_kg, 0);
  EXPECT_NEAR(yard.bed().load().mass_kg / yard.poured_kg, 1, 1e-12);
  EXPECT_NEAR(yard.bed().load().volume_m3, yard.poured_kg / 1250, 1e-9);
  // A heap no steeper than where flow starts, 33.1 deg, nor higher than the cone at repose, 32 deg:
  // h = (3 V tan^2(32 deg) / pi)^(1/3); what falls 1.6 m spreads it.
  const Columns& soil = yard.bed().columns();
  const double cone_m = std::cbrt(3 * 0.2 * std::pow(std::tan(32 * kDeg), 2) / kPi);
  EXPECT_GT(soil.HeightAt(0.3, 0.1), 0.65 * cone_m);
  EXPECT_LT(soil.HeightAt(0.3, 0.1), 1.05 * cone_m);
  for (double x = -0.5; x < 1.1; x += 0.08) {
    EXPECT_LT(std::abs(soil.HeightAt(x + 0.16, 0.1) - soil.HeightAt(x, 0.1)),
              0.16 * std::tan(34 * kDeg) + 0.02);
  }
}

TEST(Bed, FillsToTheRimThenOverflowsOntoTheGround) {
  Yard yard;
  yard.Pour(Vec2(0, 0), 6.0, 0.4);
  EXPECT_NEAR(yard.Sum_kg() / yard.poured_kg, 1, 1e-12);
  const double struck_m3 = 3 * 2 * 0.6;
  EXPECT_GT(yard.bed().load().volume_m3, struck_m3);
  // No more than a hip roof over the rim, 2 m wide, its ridge 1 m long, a little over repose.
  const double heap_m3 = (0.5 * 2 * 1 + 2 * 2 / 3.0) * std::tan(35 * kDeg);
  EXPECT_LT(yard.bed().load().volume_m3, struck_m3 + heap_m3);
  EXPECT_GT(yard.ground.GroundGain().gained_kg, 500);
  // It lies beside the walls, none under the bed's middle or far away.
  for (int j = 0; j < yard.ground.ny(); ++j) {
    for (int i = 0; i < yard.ground.nx(); ++i) {
      if (yard.ground.TopAt(i, j) < 0.05) continue;
      const Vec3 p_F =
          yard.bed().X_WF().inverse() * Vec3(yard.ground.x_m(i), yard.ground.y_m(j), 0);
      const double beside_m = std::max(std::abs(p_F.x()) - 1.5, std::abs(p_F.y()) - 1.0);
      EXPECT_GT(beside_m, -0.95);
      EXPECT_LT(beside_m, 2.0);
    }
  }
}

TEST(Bed, SoilIsSeenWhereTheCarrierTakesIt) {
  Yard yard;
  yard.Pour(Vec2(0.3, 0.1), 0.2);
  const Pose X_WB = MakePose(Vec3(-3, 4, 0.1), RotationFromRpy(0, 0, -100 * kDeg));
  yard.bed().Move(X_WB);
  yard.Wait(0.01);
  Vec3 sum = Vec3::Zero();
  double highest_m = 0;
  const auto& seen = yard.ground.surface().grains();
  for (const TerrainSurface::Grain& grain : seen) {
    sum += grain.p_W_m.cast<double>();
    highest_m = std::max<double>(highest_m, grain.p_W_m.z());
  }
  ASSERT_GT(seen.size(), 50u);
  const Vec3 middle_W = X_WB * Vec3(-0.5 + 0.3, 0.1, 1.2);
  EXPECT_NEAR((sum / seen.size() - middle_W).head<2>().norm(), 0, 0.15);
  EXPECT_NEAR(highest_m, 1.3 + yard.bed().columns().HeightAt(0.3, 0.1), 0.06);
}

TEST(Bed, AClodThrownAtAWallFromInsideStaysIn) {
  Yard yard;
  SpoilMix spoil;
  spoil.Add({12.5, 0.01, 0, 0});
  const Vec3 p_W = yard.bed().X_WF() * Vec3(0, 0, 0.3);
  yard.grains.Pour(spoil, p_W, p_W, yard.X_WB.linear() * Vec3(0, 8, 0), &yard.ground);
  yard.Wait(3);
  EXPECT_NEAR(yard.bed().mass_kg(), 12.5, 1e-9);
}

TEST(Bed, SoilUnderItStaysOnTheGround) {
  Yard yard;
  SpoilMix spoil;
  spoil.Add({12.5, 0.01, 0, 0});
  const Vec3 p_W = yard.bed().X_WF() * Vec3(0, 0, -0.8);
  yard.grains.Pour(spoil, p_W, p_W, Vec3::Zero(), &yard.ground);
  yard.Wait(kAtRest_s);
  EXPECT_EQ(yard.bed().mass_kg(), 0);
  EXPECT_NEAR(yard.ground.GroundGain().net_kg, 12.5, 1e-9);
}

}  // namespace
}  // namespace tera
