#include "soil/flow/bed_flow.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

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
  sand.soil_tool_friction_rad = 22 * kDeg;
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
  /// Lays soil evenly on the floor.
  void Fill(double depth_m) {
    const Columns& floor = bed().columns();
    const double part_m3 = floor.area_m2() * depth_m;
    for (int j = 0; j < floor.ny(); ++j) {
      for (int i = 0; i < floor.nx(); ++i) {
        bed().Deposit(bed().X_WF() * Vec3(floor.x_m(i), floor.y_m(j), 0),
                      {1250 * part_m3, part_m3, 0, 0});
      }
    }
    poured_kg = bed().mass_kg();
    Wait(0.1);
  }
  /// Turns the bed about its tail's lower edge.
  void Tip(double pitch_rad, double roll_rad = 0, bool gate_is_open = false) {
    const Vec3 hinge_B(-2, 0, 1.2);
    bed().Move(X_WB * MakePose(hinge_B, RotationFromRpy(roll_rad, pitch_rad, 0)) *
                   MakePose(Vec3(-hinge_B)),
               gate_is_open);
  }
  /// Does so within half a minute, about as a hoist does.
  void TipSlowly(double pitch_rad, double roll_rad = 0) {
    constexpr int kSteps = 100;
    for (int k = 1; k <= kSteps; ++k) {
      Tip(pitch_rad * k / kSteps, roll_rad * k / kSteps);
      Wait(0.25);
    }
    Wait(2 * kAtRest_s);
  }
  /// Width that its columns cover.
  double width_m() { return bed().columns().ny() * bed().columns().cell_m(); }
  double volume_m3() { return bed().mass_kg() / 1250; }
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

TEST(Bed, ThatTipsLessThanSteelHoldsShiftsNothing) {
  for (const auto& [pitch_rad, roll_rad] : {std::pair{-20 * kDeg, 0.0}, {0.0, 20 * kDeg}}) {
    Yard yard;
    yard.Fill(0.4);
    yard.TipSlowly(pitch_rad, roll_rad);
    const Columns& soil = yard.bed().columns();
    for (int j = 0; j < soil.ny(); ++j) {
      for (int i = 0; i < soil.nx(); ++i) ASSERT_NEAR(soil.TopAt(i, j), 0.4, 1e-9) << i << " " << j;
    }
    EXPECT_EQ(yard.bed().mass_kg(), yard.poured_kg);
  }
}

/// A wedge V = l h^2 / (2 tan(tilt - surface)) stays behind a shut gate or wall of height h, over
/// its length l. Its surface stands at repose or up to the 1.1 deg above at which soil starts to
/// flow.
TEST(Bed, ThatTipsWithAllWallsShutHoldsAWedgeBehindTheLowerOne) {
  struct Turn {
    double pitch_rad, roll_rad, wall_length_m;
  };
  for (const Turn& turn : {Turn{-45 * kDeg, 0, 2}, {-60 * kDeg, 0, 2}, {0, 60 * kDeg, 3}}) {
    Yard yard;
    yard.Fill(0.6);
    yard.TipSlowly(turn.pitch_rad, turn.roll_rad);
    const double tilt_rad = std::abs(turn.pitch_rad) + std::abs(turn.roll_rad);
    const double wedge_rad =
        std::atan(turn.wall_length_m * std::pow(yard.wall_m, 2) / (2 * yard.volume_m3()));
    RecordProperty(
        fmt::format("surface_{}_{:.0f}_deg", turn.roll_rad > 0 ? "roll" : "pitch", tilt_rad / kDeg),
        fmt::format("{:.1f}", (tilt_rad - wedge_rad) / kDeg));
    EXPECT_NEAR((tilt_rad - wedge_rad) / kDeg, 32.5, 1.0) << tilt_rad / kDeg;
    const Columns& soil = yard.bed().columns();
    const auto heights_m = [&] {
      std::vector<double> tops_m;
      for (int k = 0; k < soil.nx() * soil.ny(); ++k) {
        tops_m.push_back(soil.TopAt(k % soil.nx(), k / soil.nx()));
      }
      return tops_m;
    };
    yard.Wait(4 * kAtRest_s);
    const std::vector<double> before_m = heights_m();
    yard.Wait(1);
    EXPECT_EQ(heights_m(), before_m) << "it does not come to rest";
    EXPECT_NEAR(yard.Sum_kg() / yard.poured_kg, 1, 1e-12);
  }
}

/// Below the friction of steel, soil under the slope at repose from the open gate's lip stays. In
/// the bed that slope rises at repose less the tilt.
TEST(Bed, WithAnOpenGateKeepsWhatLiesUnderReposeFromItsLip) {
  for (const double tilt_rad : {0.0, 10 * kDeg, 18 * kDeg}) {
    Yard yard;
    yard.Fill(0.4);
    yard.Tip(-tilt_rad, 0, true);
    yard.Wait(2 * kAtRest_s);
    const double rise = std::tan(32 * kDeg - tilt_rad);
    const double fallen_m3 = yard.width_m() * 0.4 * 0.4 / rise / 2;
    const double filled_m3 = yard.poured_kg / 1250;
    RecordProperty(fmt::format("kept_{:.0f}_deg_m3", tilt_rad / kDeg),
                   fmt::format("{:.3f}, {:.3f}", yard.volume_m3(), filled_m3 - fallen_m3));
    EXPECT_NEAR((filled_m3 - yard.volume_m3()) / fallen_m3, 1, 0.1) << tilt_rad / kDeg;
    EXPECT_NEAR(yard.Sum_kg() / yard.poured_kg, 1, 1e-12);
  }
}

/// On a floor at 30 deg, of friction 22 deg, a block gains g (sin 30 - cos 30 tan 22) of speed. So
/// does the load's upper end; soil spreads about it by a few columns.
TEST(Bed, ItsLoadSlidesOutAsABlockOverAnOpenGate) {
  Yard yard;
  yard.Fill(0.3);
  yard.Tip(-30 * kDeg, 0, true);
  const double a_mps2 = 9.80665 * (std::sin(30 * kDeg) - std::cos(30 * kDeg) * std::tan(22 * kDeg));
  for (const double t_s : {0.5, 1.0, 1.5}) {
    yard.Wait(0.5);
    double end_m = 1.5;
    while (yard.bed().columns().HeightAt(end_m, 0.1) < 0.15) end_m -= 0.01;
    RecordProperty(fmt::format("slid_{:.1f}_s_m", t_s),
                   fmt::format("{:.2f}, {:.2f}", 1.5 - end_m, 0.5 * a_mps2 * t_s * t_s));
    EXPECT_NEAR(1.5 - end_m, 0.5 * a_mps2 * t_s * t_s, 0.2) << t_s;
  }
}

TEST(Bed, ThatTipsOverTheFrictionOfSteelEmptiesItselfOntoTheGroundBehind) {
  for (const double tilt_rad : {26 * kDeg, 45 * kDeg, 60 * kDeg}) {
    Yard yard;
    yard.Fill(0.6);
    yard.Tip(-tilt_rad, 0, true);
    yard.Wait(2 * kAtRest_s);
    RecordProperty(fmt::format("left_{:.0f}_deg", tilt_rad / kDeg),
                   fmt::format("{:.4f}", yard.bed().mass_kg() / yard.poured_kg));
    EXPECT_LT(yard.bed().mass_kg() / yard.poured_kg, 0.005) << tilt_rad / kDeg;
    EXPECT_NEAR(yard.Sum_kg() / yard.poured_kg, 1, 1e-12);
    EXPECT_NEAR(yard.bed().load().mass_kg, yard.bed().mass_kg(), 1e-9);
    const Columns& ground = yard.ground;
    double sum_m = 0, moment_m2 = 0;
    for (int j = 0; j < ground.ny(); ++j) {
      for (int i = 0; i < ground.nx(); ++i) {
        const Vec3 p_B = yard.X_WB.inverse() * Vec3(ground.x_m(i), ground.y_m(j), 0);
        sum_m += ground.TopAt(i, j), moment_m2 += ground.TopAt(i, j) * p_B.x();
      }
    }
    EXPECT_LT(moment_m2 / sum_m, -2.2) << tilt_rad / kDeg;  // its tail is at -2 m
  }
}

TEST(Bed, HoldsWhatIsPouredIntoItAtRepose) {
  Yard yard;
  yard.Pour(Vec2(0.3, 0.1), 0.2);
  EXPECT_NEAR(yard.bed().mass_kg() / yard.poured_kg, 1, 1e-12);
  EXPECT_EQ(yard.ground.GroundGain().gained_kg, 0);
  EXPECT_NEAR(yard.bed().load().mass_kg / yard.poured_kg, 1, 1e-12);
  EXPECT_NEAR(yard.bed().load().volume_m3, yard.poured_kg / 1250, 1e-9);
  // A heap is no steeper than the start angle of flow, 33.1 deg. It is no higher than the cone at
  // repose, 32 deg: h = (3 V tan^2(32 deg) / pi)^(1/3). Soil that falls 1.6 m spreads it.
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
