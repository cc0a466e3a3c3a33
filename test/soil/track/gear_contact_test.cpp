#include "soil/track/gear_contact.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "soil/block_fixture.h"
#include "soil/track/terramechanics.h"

namespace tera {
namespace {

using namespace testing_soil;

/// Bekker's sinkage of the dry sand at that many times the block's mean pressure, by hand.
double MeanSinkage_m(const SoilType& soil, double pressure_pa) {
  const double modulus_npm_n2 = soil.k_c_npm_n1 / kWidth_m + soil.k_phi_npm_n2;
  return std::pow(pressure_pa / modulus_npm_n2, 1 / soil.sinkage_exponent);
}

double DrySandSinkage_m(double times) { return 0.0371 * std::pow(times, 1 / 1.1); }
constexpr auto kNothing = [](const Vec3&) {};

/// The block's depth at rest: Bekker's 37.1 mm, and the rebound: a plate of width b on a half space
/// settles by p b (1 - nu^2) I / E, nu = 0.3, I = 0.88.
constexpr double kDepth_m = 0.0371 + 40875 * kWidth_m * (1 - 0.09) * 0.88 / 4.5e6;

TEST(GearContact, BlockSinksToBekkersDepthAndIsCarriedInFull) {
  Block block(kDrySand, Vec2(-2.013, 0.217), 0.3);
  Vec3 force_n;
  for (int k = 0; k < 4000; ++k) force_n = block.ActAndSinkGently();
  EXPECT_NEAR(force_n.z() / (kMass_kg * kStandardGravity_mps2), 1, 1e-3);
  // Ground that slopes down from the rut's rim within a cell bears some of the weight: 2 %.
  EXPECT_NEAR(block.reaction.gear_sinkage_m[0] / kDepth_m, 1, 0.02);
  EXPECT_NEAR(-block.links[0].X_WB.translation().z() / kDepth_m, 1, 0.02);
  EXPECT_EQ(block.reaction.gear_slip[0], 0);
}

/// Both tracks, 39.24 kN, dry sand, K = 25 mm: closed form, see terramechanics_test.cpp.
const std::vector<std::pair<double, double>> kThrustOverSlip = {
    {0.05, 15310}, {0.10, 18450}, {0.20, 20150}, {0.40, 21010}};

/// Mean over the second half of a drive.
double Thrust_n(Block* block, double shoe_mps, double slip) {
  block->motion.gear_rate_radps = {shoe_mps / 0.25, shoe_mps / 0.25};
  double sum_n = 0;
  const int steps = static_cast<int>(5.0 / shoe_mps / kStep_s);
  for (int k = 0; k < steps; ++k) {
    block->links[0].v_WB_mps.x() = (1 - slip) * shoe_mps;
    block->ActAndSinkGently();
    if (k < steps / 2) continue;
    sum_n += block->reaction.gear_traction_n[0] + block->reaction.gear_traction_n[1];
  }
  EXPECT_NEAR(block->reaction.gear_slip[0], slip, 1e-6);
  return sum_n / (steps - steps / 2);
}

TEST(GearContact, ThrustFollowsTheClosedFormOverSlip) {
  // Damping of the shear near rest still adds 2 % at 5 cm/s of slip.
  for (const auto& [slip, expected_n] : kThrustOverSlip) {
    Block block(kDrySand, Vec2(-4.5, 0.1));
    block.Stand(2000);
    EXPECT_NEAR(Thrust_n(&block, 1.0, slip) / expected_n, 1, 0.03) << "slip " << slip;
  }
}

TEST(GearContact, FineContactMeetsTheClosedFormsWithinOnePercent) {
  // Cells of 2.5 cm, patches of 10 cm, and slip too fast for the damping near rest.
  for (const auto& [slip, expected_n] : kThrustOverSlip) {
    Block block(fmt::format("{}cell_m: 0.025\n", kDrySand), Vec2(-4.5, 0.1), 0, {.patches = 16});
    block.Stand(3000);
    EXPECT_NEAR(-block.links[0].X_WB.translation().z() / kDepth_m, 1, 0.01);
    EXPECT_NEAR(Thrust_n(&block, 4.0, slip) / expected_n, 1, 0.01) << "slip " << slip;
  }
}

TEST(GearContact, NothingOutrunsItsShoesOnLevelGround) {
  // Resistance of the soil is met by thrust, which takes slip: of flat tracks and of raised noses,
  // which sink up to 7 cm, forwards and backwards.
  for (const char* soil : {"gravel", "dirt", "sand"}) {
    for (const double nose_m : {0.0, 0.25}) {
      for (const double shoe_mps : {1.0, -1.0}) {
        Block block("size_m: [14, 4]\nsoil: " + std::string(soil) + "\n",
                    Vec2(-4.1 * shoe_mps, 0.1), 0, {.nose_m = nose_m});
        for (int k = 0; k < 500; ++k) block.Move();
        block.motion.gear_rate_radps = {shoe_mps / 0.25, shoe_mps / 0.25};
        block.links[0].v_WB_mps.x() = shoe_mps;
        for (int k = 0; k < 2500; ++k) block.Move();
        const double start_m = block.links[0].X_WB.translation().x();
        double slip = 0;
        const int count = 1000;
        for (int k = 0; k < count; ++k) {
          block.Move();
          slip += block.reaction.gear_slip[0] / count;
        }
        const double moved_m = block.links[0].X_WB.translation().x() - start_m;
        const double lost = 1 - moved_m / (shoe_mps * count * kStep_s);
        const std::string what = fmt::format("{}, noses {} m, {} m/s", soil, nose_m, shoe_mps);
        EXPECT_GT(lost, 0) << what;
        EXPECT_LT(lost, 0.05) << what;
        EXPECT_NEAR(slip, lost, 1e-5) << what;
      }
    }
  }
}

TEST(GearContact, BlockOnASlopeHoldsStillWithoutCreep) {
  // 10 deg, well below the friction angle; tracks locked. Free along the slope and in z.
  Block block("size_m: [12, 4]\nsoil: dirt\nrelief: {slope_deg: 10}\n", Vec2(0, 0));
  const double slope = 10 * kDeg;
  block.links[0].X_WB = MakePose(Vec3(0, 0, 0.002), RotationFromRpy(0, -slope, 0));
  double x_settled_m = 0;
  for (int k = 0; k < 6000; ++k) {
    block.Move();
    if (k == 3000) x_settled_m = block.links[0].X_WB.translation().x();
  }
  EXPECT_NEAR(block.links[0].X_WB.translation().x(), x_settled_m, 1e-4);
  EXPECT_LT(block.links[0].v_WB_mps.norm(), 1e-4);
  EXPECT_NEAR(block.reaction.link_wrench[0].force_W_n.z(), kMass_kg * kStandardGravity_mps2,
              0.01 * kMass_kg * kStandardGravity_mps2);
}

TEST(GearContact, FallingBlockComesToRestAndNothingPullsItDown) {
  Block block("size_m: [12, 4]\nsoil: gravel\n", Vec2(0.3, -0.1), 1.0);
  block.links[0].X_WB.translation().z() = 0.05;
  double vz_mps = 0;
  for (int k = 0; k < 4000; ++k) {
    block.links[0].v_WB_mps.z() = vz_mps;
    const Vec3 force_n = block.Act();
    ASSERT_GE(force_n.z(), 0);
    ASSERT_LT(force_n.z(), 30 * kMass_kg * kStandardGravity_mps2);
    vz_mps += kStep_s * (force_n.z() / kMass_kg - kStandardGravity_mps2);
    block.links[0].X_WB.translation().z() += kStep_s * vz_mps;
  }
  EXPECT_LT(std::abs(vz_mps), 1e-3);
  EXPECT_LT(-block.links[0].X_WB.translation().z(), 0.05);
}

TEST(GearContact, DrivingLeavesTwoRutsAndLosesNoMass) {
  Block block("size_m: [12, 4]\nsoil: sand\n", Vec2(-3, 0));
  for (int k = 0; k < 1000; ++k) block.ActAndSinkGently();
  block.motion.gear_rate_radps = {4.4, 4.4};
  for (int k = 0; k < 2500; ++k) {
    block.links[0].v_WB_mps.x() = 1.0;
    block.ActAndSinkGently();
  }
  const TerrainSurface& ground = block.soil->surface();
  EXPECT_LT(ground.HeightAt(0, kGauge_m / 2), -0.02);
  EXPECT_LT(ground.HeightAt(0, -kGauge_m / 2), -0.02);
  EXPECT_NEAR(ground.HeightAt(0, 1.6), 0, 1e-6);  // farther from both than soil heaves
  EXPECT_GT(ground.at(ground.nx / 2, (ground.ny - 1) / 2 + 12).cover.rut, 200);
  const MassLedger ledger = block.soil->ledger();
  EXPECT_NEAR(ledger.total_kg(), 0, 1e-9);
}

TEST(GearContact, ShearingBackAndForthDissipates) {
  // Locked tracks on sand, K = 18 mm, pushed on by 2 K: 1 - e^-2 = 0.865 of the strength. Unloading
  // at the initial stiffness strength / K spends that within 0.865 K. As much further on, the soil
  // resists the other way with 1 - e^-0.865 = 0.579 of the strength.
  Block block("size_m: [12, 4]\nsoil: sand\n", Vec2(0.1, 0), 0);
  for (int k = 0; k < 2000; ++k) block.ActAndSinkGently();
  const double strength_n =
      kMass_kg * kStandardGravity_mps2 * std::tan(28 * kDeg) + 2 * kWidth_m * kLength_m * 1040;
  const auto push = [&](double distance_m) {
    const double speed_mps = std::copysign(0.002, distance_m);
    Vec3 force_n;
    for (int k = 0; k < std::lround(distance_m / speed_mps / kStep_s); ++k) {
      block.links[0].v_WB_mps.x() = speed_mps;
      force_n = block.ActAndSinkGently();
    }
    return force_n.x() / strength_n;
  };
  EXPECT_NEAR(push(0.036), -0.865, 0.03);
  EXPECT_NEAR(push(-0.865 * 0.018), 0, 0.03);
  EXPECT_NEAR(push(-0.865 * 0.018), 0.579, 0.03);
}

TEST(GearContact, ShoesThatLiftOffAndComeDownInTheirPrintsAreStillSheared) {
  // Locked tracks pushed on by 2 K, K = 18 mm: 1 - e^-2 of the strength. Lifted straight up and set
  // down again they meet the soil that stayed between the ribs; set down 10 K farther on, fresh
  // one.
  for (const double aside_m : {0.0, 0.18}) {
    Block block("size_m: [12, 4]\nsoil: sand\n", Vec2(0.1, 0), 0);
    block.Stand(2000);
    const auto move = [&](const Vec3& by_m, int steps) {
      for (int k = 0; k < steps; ++k) {
        block.links[0].v_WB_mps = by_m / (steps * kStep_s);
        block.Act();
        block.links[0].X_WB.translation() += kStep_s * block.links[0].v_WB_mps;
      }
      block.links[0].v_WB_mps.setZero();
    };
    for (int k = 0; k < 9000; ++k) {
      block.links[0].v_WB_mps.x() = 0.002;
      block.ActAndSinkGently();
    }
    block.links[0].v_WB_mps.x() = 0;
    move(Vec3(0, 0, 0.1), 500);
    move(Vec3(aside_m, 0, 0), 500);
    move(Vec3(0, 0, -0.1), 500);
    Vec3 force_n;
    for (int k = 0; k < 1000; ++k) force_n = block.ActAndSinkGently();
    const double strength_n =
        kMass_kg * kStandardGravity_mps2 * std::tan(28 * kDeg) + 2 * kWidth_m * kLength_m * 1040;
    EXPECT_NEAR(force_n.x() / strength_n, aside_m > 0 ? 0 : -0.865, 0.05) << aside_m;
  }
}

TEST(GearContact, SandThatIsPressedAsideDoesNotComeBackUnderTheTrack) {
  // A machine twice as heavy presses the sand beyond its greatest density, so that some of it goes
  // aside. Driving on costs the work of the rut, once: Bekker's compaction resistance.
  Block block("size_m: [12, 4]\nsoil: sand\n", Vec2(-3, 0.02));
  block.mass_kg = 2 * kMass_kg;
  for (int k = 0; k < 1000; ++k) block.ActAndSinkGently();
  block.motion.gear_rate_radps = {4, 4};
  double drag_n = 0;
  const int settle = 1000, count = 1500;
  for (int k = 0; k < settle + count; ++k) {
    block.links[0].v_WB_mps.x() = 1.0;
    const Vec3 force_n = block.ActAndSinkGently();
    const SoilReaction& r = block.reaction;
    if (k >= settle) drag_n += (r.gear_traction_n[0] + r.gear_traction_n[1] - force_n.x()) / count;
  }
  const SoilType& sand = block.soil->soils()[0];
  const double pressure_pa = block.mass_kg * kStandardGravity_mps2 / (2 * kWidth_m * kLength_m);
  const double z_m = MeanSinkage_m(sand, pressure_pa);
  const double expected_n =
      kWidth_m * BekkerWork_jpm2(sand, kWidth_m, z_m) + BulldozingResistance_n(sand, kWidth_m, z_m);
  EXPECT_NEAR(drag_n / (2 * expected_n), 1, 0.1);
}

TEST(GearContact, SecondPassSinksOnlyFromWhereTheFirstHasPressed) {
  // Up to its largest past pressure, pressed ground is as stiff as on unloading. A second pass of
  // the same machine leaves the rut as it was. One twice as heavy makes it 2^(1/n) times as deep.
  Block block(kDrySand, Vec2(-2, 0));
  block.Stand();
  block.Drive(5, 1.0, 0, kNothing);
  const double first_m = block.Rut_m(0);
  block.Drive(5, -1.0, 0, kNothing);
  const double second_m = block.Rut_m(0);
  block.mass_kg *= 2;
  block.Stand();
  double third_m = 0;  // under the block: behind it sand comes down from both ridges
  block.Drive(5, 1.0, 0, [&](const Vec3&) { third_m = -block.links[0].X_WB.translation().z(); });
  const double rebound_m = 2 * (kDepth_m - DrySandSinkage_m(1));
  EXPECT_NEAR(first_m / DrySandSinkage_m(1), 1, 0.05);
  EXPECT_NEAR(second_m / first_m, 1, 0.02);
  EXPECT_NEAR((third_m - rebound_m) / DrySandSinkage_m(2), 1, 0.05);
}

/// Volumes of the ground below and above its level.
std::pair<double, double> LoweredAndRaised_m3(const TerrainSurface& ground) {
  double lowered_m3 = 0, raised_m3 = 0;
  for (int j = 0; j < ground.ny; ++j) {
    for (int i = 0; i < ground.nx; ++i) {
      const double m3 = ground.at(i, j).height_m * ground.cell_m * ground.cell_m;
      (m3 < 0 ? lowered_m3 : raised_m3) += std::abs(m3);
    }
  }
  return {lowered_m3, raised_m3};
}

TEST(GearContact, ATurnOnTheSpotShovesSandAsideRatherThanPressingItTogether) {
  // Sheared sand keeps its volume but for compression by the pressure. A void ratio of 0.81 loses
  // 0.05 log10(1 + 41 kPa / 10 kPa) = 0.035, 2 % of the 0.3 m below, 6 mm of some 3 cm.
  Block block("size_m: [8, 8]\nsoil: sand\n", Vec2(0, 0), 0, {.nose_m = 0.25});
  block.Stand();
  const double rate_radps = 0.4, shoe_mps = rate_radps * kGauge_m / 2;
  block.motion.gear_rate_radps = {-shoe_mps / 0.25, shoe_mps / 0.25};
  block.links[0].w_WB_radps.z() = rate_radps;
  for (int k = 0; k < 4000; ++k) {
    block.ActAndSinkGently();
    block.links[0].X_WB.linear() =
        RotationFromRpy(0, 0, rate_radps * kStep_s) * block.links[0].X_WB.linear();
  }
  const TerrainSurface& ground = block.soil->surface();
  const auto [lowered_m3, raised_m3] = LoweredAndRaised_m3(ground);
  EXPECT_GT(lowered_m3, 0.03);
  EXPECT_GT(raised_m3 / lowered_m3, 0.6);
  EXPECT_LT(raised_m3 / lowered_m3, 1);
  EXPECT_NEAR(block.soil->ledger().total_kg(), 0, 1e-9);
  // The lowered volume is raised, but for the soil pressed together; heaved soil lies loosely.
  const SoilType& sand = block.soil->soils()[0];
  const SoilVoxels cubes = block.soil->Voxels({Vec3(-2.5, -2.5, -0.6), Vec3(2.5, 2.5, 0.4)});
  double pressed_m3 = 0, loosened_m3 = 0;
  for (std::size_t k = 0; k < cubes.size(); ++k) {
    const double m3 = cubes.fill[k] * std::pow(cubes.edge_m, 3);
    const double bank_m3 = cubes.mass_kg[k] / sand.bank_density_kgpm3;
    const double loose_m3 = cubes.loose[k] * bank_m3;
    loosened_m3 += (sand.swell - 1) * loose_m3;
    pressed_m3 += bank_m3 + (sand.swell - 1) * loose_m3 - m3;
  }
  EXPECT_NEAR((lowered_m3 - raised_m3) / (pressed_m3 - loosened_m3), 1, 0.05);
  RecordProperty("pressed_loosened_m3", fmt::format("{:.4f} {:.4f}", pressed_m3, loosened_m3));
  // Between the tracks, where sand heaves from both all the way round, and in the berm outside.
  double mound_m = 0, berm_m = 0;
  for (int j = 0; j < ground.ny; ++j) {
    for (int i = 0; i < ground.nx; ++i) {
      const bool is_outside = Vec2(ground.x_m(i), ground.y_m(j)).norm() > 0.8;
      double& highest_m = is_outside ? berm_m : mound_m;
      highest_m = std::max<double>(highest_m, ground.at(i, j).height_m);
    }
  }
  EXPECT_GT(berm_m, 0.02);
  EXPECT_LT(berm_m, 0.08);
  EXPECT_LT(mound_m, 0.12);
  RecordProperty("lowered_m3", fmt::format("{:.3f}", lowered_m3));
  RecordProperty("raised_m3", fmt::format("{:.3f}", raised_m3));
  RecordProperty("mound_and_berm_cm", fmt::format("{:.1f} {:.1f}", 100 * mound_m, 100 * berm_m));
}

TEST(GearContact, SandHeavesBesideATrackAsFarAsPrandtlsSlipSurfaceReaches) {
  // N_q of local shear, tan phi' = 2/3 tan 28 deg, is 6.1 (Das, table 3.1, at 19.5 deg): it comes
  // out sqrt(6.1) b = 0.74 m beside. Heave falls off evenly to there. It is the loss of one half of
  // the rut, but for the 2 % pressed together, over half of the way.
  Block block("size_m: [12, 8]\nsoil: sand\n", Vec2(-3, 0));
  block.Stand();
  block.Drive(6, 1.0, 0, kNothing);
  const TerrainSurface& ground = block.soil->surface();
  const auto mean_m = [&](double out_m) {  // outside the left track, along its way
    double sum_m = 0;
    for (int n = 0; n < 40; ++n) sum_m += ground.HeightAt(-1 + 0.05 * n, 0.75 + out_m) / 40;
    return sum_m;
  };
  const double edge_m = 0.5 * kWidth_m * (block.Rut_m(0) - 0.006) / (0.5 * 0.74);
  EXPECT_NEAR(mean_m(0.17) / edge_m, 0.83, 0.2);
  EXPECT_NEAR(mean_m(0.37) / edge_m, 0.57, 0.15);
  EXPECT_NEAR(mean_m(0.57) / edge_m, 0.30, 0.12);
  EXPECT_EQ(mean_m(0.95), 0);
}

TEST(GearContact, RutsAreAsDeepInCellsOfAllSizes) {
  // Bekker's depth at the mean pressure, wherever the columns stand under the shoes.
  for (const char* name : {"dirt", "loose_sand"}) {
    for (const double cell_m : {0.04, 0.05, 0.07, 0.10}) {
      Block block(fmt::format("size_m: [8, 4]\nsoil: {}\ncell_m: {}\n", name, cell_m),
                  Vec2(-1.513, 0.017), 0.1);
      const Pose X_WB = block.links[0].X_WB;
      block.Stand(500);
      block.motion.gear_rate_radps = {4, 4};
      for (int k = 0; k < 1500; ++k) {
        block.links[0].v_WB_mps.head<2>() = X_WB.linear().col(0).head<2>();
        block.ActAndFall();
        block.links[0].X_WB.translation() += kStep_s * block.links[0].v_WB_mps;
      }
      double rut_m = 0;
      for (int n = 0; n < 50; ++n) {
        const Vec3 p_W = X_WB * Vec3(1.2 + 0.01 * n, 0.5 * kGauge_m, 0);
        rut_m -= block.soil->surface().HeightAt(p_W.x(), p_W.y()) / 50;
      }
      const double pressure_pa = kMass_kg * kStandardGravity_mps2 / (2 * kWidth_m * kLength_m);
      const double bekker_m = MeanSinkage_m(block.soil->soils()[0], pressure_pa);
      EXPECT_NEAR(rut_m / bekker_m, 1, 0.15) << name << ", cells of " << cell_m << " m";
      RecordProperty(fmt::format("{}_{:.0f}_cm", name, 100 * cell_m),
                     fmt::format("{:.1f} {:.1f}", 1e3 * rut_m, 1e3 * bekker_m));
    }
  }
}

TEST(GearContact, RutsTakeTheSameWorkInCellsOfAllSizes) {
  // A track 0.3 m wide along the grid has 8 columns of 4 cm under its width, 6 of 5 cm, or 4 of 7
  // cm.
  std::vector<double> drag_n;
  for (const double cell_m : {0.05, 0.04, 0.07}) {
    Block block(fmt::format("size_m: [8, 4]\nsoil: loose_sand\ncell_m: {}\n", cell_m),
                Vec2(-1.513, 0.017));
    block.Stand(500);
    block.motion.gear_rate_radps = {4, 4};
    double sum_n = 0;
    constexpr int kSteps = 1500, kMeasured = 600;
    for (int k = 0; k < kSteps; ++k) {
      block.links[0].v_WB_mps.x() = 1;
      const Vec3 force_n = block.ActAndSinkGently();
      const SoilReaction& r = block.reaction;
      const double thrust_n = r.gear_traction_n[0] + r.gear_traction_n[1];
      if (k >= kSteps - kMeasured) sum_n += (thrust_n - force_n.x()) / kMeasured;
    }
    drag_n.push_back(sum_n);
    RecordProperty(fmt::format("drag_n_{:.0f}_cm", 100 * cell_m), fmt::format("{:.0f}", sum_n));
    EXPECT_NEAR(sum_n / drag_n.front(), 1, 0.03) << cell_m;
  }
}

TEST(GearContact, LockedTracksHoldATorqueAsTheirShearStrengthAllows) {
  // A machine on two tracks that do not roll, turned to and fro by a swing. At a turn t the stress
  // at a distance r from the middle is (c + p tan phi)(1 - exp(-r t / K)): the torque for all of it
  // is that times r, over both tracks. Two fifths of the
  // strength, to and fro, leave it where it stands.
  Block block("size_m: [8, 8]\nsoil: dirt\n", Vec2(0.02, 0.01));
  block.Stand(2000);
  const SoilType& dirt = block.soil->soils()[0];
  const double area_m2 = 2 * kWidth_m * kLength_m;
  const double stress_pa = dirt.shear_cohesion_pa + kMass_kg * kStandardGravity_mps2 / area_m2 *
                                                        std::tan(dirt.shear_friction_rad);
  const auto torque_nm = [&](double turn_rad) {
    double sum_nm = 0;
    constexpr int kParts = 100;
    for (int a = 0; a < kParts; ++a) {
      for (int b = 0; b < kParts; ++b) {
        const double r_m = std::hypot(kLength_m * ((a + 0.5) / kParts - 0.5),
                                      0.5 * kGauge_m + kWidth_m * ((b + 0.5) / kParts - 0.5));
        sum_nm += r_m * stress_pa * -std::expm1(-r_m * turn_rad / dirt.shear_modulus_m) * area_m2 /
                  (kParts * kParts);
      }
    }
    return sum_nm;
  };
  const double most_nm = torque_nm(1);
  double turned_rad = 0, rate_radps = 0, share = 0;
  const auto swing = [&](double to_share) {  // within two seconds
    constexpr int kSteps = 1000;
    const double from_share = std::exchange(share, to_share);
    for (int k = 1; k <= kSteps; ++k) {
      block.links[0].w_WB_radps.z() = rate_radps;
      block.ActAndSinkGently();
      const double ground_nm = block.reaction.link_wrench[0].torque_W_nm.z();
      const double now = from_share + (to_share - from_share) * k / kSteps;
      rate_radps += kStep_s * (now * most_nm + ground_nm) / 4000;
      turned_rad += kStep_s * rate_radps;
      block.links[0].X_WB.linear() =
          RotationFromRpy(0, 0, kStep_s * rate_radps) * block.links[0].X_WB.linear();
    }
  };
  swing(0.4);
  const double first_rad = turned_rad;
  EXPECT_NEAR(torque_nm(first_rad) / most_nm, 0.4, 0.04);
  for (int n = 0; n < 5; ++n) {
    swing(-0.4);
    swing(0.4);
  }
  EXPECT_NEAR(turned_rad / first_rad, 1, 0.1);
  swing(1.05);
  EXPECT_GT(turned_rad, 5 * first_rad);
}

/// A track of the block with half of its weight on dirt, which drives along x over its origin.
/// Results are the depth of its rut there and the density of the uppermost soil.
struct FillTest {
  Columns ground = LevelColumns(Shipped("dirt"), 0.05, 121);
  double level_m = 0;

  explicit FillTest(bool is_fill) {
    for (int j = 0; is_fill && j < ground.ny(); ++j) {
      for (int i = 0; i < ground.nx(); ++i) ground.Break(ground.Touch(i, j), 0.6);
    }
    level_m = ground.HeightAt(0, 0);
  }
  void Pass(double mass_kg) {
    GearContact track(FlatTrack(0, kLength_m, kWidth_m, kPatches), true, ground.soils());
    BodyState body;
    body.X_WB = MakePose(Vec3(-2, 0, level_m + 0.001), 0, 0, 0);
    for (int k = 0; k < 2000; ++k) {
      const auto result = track.Act(body, 1.0 / 0.25, kStep_s, LowObstacles(), &ground);
      body.v_WB_mps.x() = 1;
      body.v_WB_mps.z() +=
          kStep_s * (result.wrench.force_W_n.z() / mass_kg - kStandardGravity_mps2);
      body.X_WB.translation() += kStep_s * body.v_WB_mps;
    }
  }
  double Rut_m() const { return level_m - ground.HeightAt(0, 0); }
  const Column& Middle() const { return ground.at(ground.IdAt(60, 60)); }
};

TEST(GearContact, FreshFillRutsDeeperThanFirmGroundAndBecomesDenser) {
  // Dug dirt of 1340 kg/m3, 0.6 m deep, and as it lies, 1474: the modulus is (1340 / 1474)^12.4 =
  // 0.31 of the firm one's, so that without getting denser the rut were 0.31^(-1 / 0.7) = 5.4 times
  // as deep.
  FillTest firm(false), fill(true);
  firm.Pass(1750);
  fill.Pass(1750);
  EXPECT_GT(fill.Rut_m() / firm.Rut_m(), 2);
  EXPECT_LT(fill.Rut_m() / firm.Rut_m(), 5.4);
  const double fill_kgpm3 = fill.Middle().top_layer()->density_kgpm3();
  EXPECT_GT(fill_kgpm3, 1355);
  EXPECT_LT(fill_kgpm3, 1474);
  RecordProperty("firm_rut_mm", fmt::format("{:.1f}", 1e3 * firm.Rut_m()));
  RecordProperty("fill_rut_mm", fmt::format("{:.1f}", 1e3 * fill.Rut_m()));
  RecordProperty("fill_kgpm3", fmt::format("{:.0f}", fill_kgpm3));
}

TEST(GearContact, TampedFillBearsWhatRutsFreshFill) {
  // A machine three times as heavy tamps it first: its rut holds the light one without sinking.
  FillTest fresh(true), tamped(true);
  fresh.Pass(1750);
  tamped.Pass(3 * 1750);
  const double tamped_m = tamped.Rut_m();
  const double firmness = FirmnessOf(tamped.Middle(), tamped.ground.soils());
  EXPECT_GT(firmness, 1.2 * FirmnessOf(fresh.Middle(), fresh.ground.soils()));
  tamped.Pass(1750);
  EXPECT_LT(tamped.Rut_m() - tamped_m, 0.1 * fresh.Rut_m());
}

TEST(GearContact, GroundReboundsWhenTheLoadIsGone) {
  // A plate of width b on a half space: p b (1 - nu^2) I / E, nu = 0.3, I = 0.88.
  Block block(kDrySand, Vec2(0.11, -0.07), 0.2);
  block.Stand(3000);
  const double rebound_m = 40875 * kWidth_m * (1 - 0.09) * 0.88 / 4.5e6;
  const double x_m = 0.11 - 0.6 * std::sin(0.2), y_m = -0.07 + 0.6 * std::cos(0.2);
  const double rut_m = -block.soil->surface().HeightAt(x_m, y_m);
  EXPECT_NEAR(-block.links[0].X_WB.translation().z() - rut_m, rebound_m, 0.05 * rebound_m);
}

TEST(GearContact, RoadWheelsPressTheRutDeeperThanTheMeanPressureWould) {
  // Where the track has driven, its pressure has peaks of twice the mean: the rut grows with the
  // way towards 2^(1/n) of Bekker's depth. New ground under the front carries some of the load.
  Block block(kDrySand, Vec2(-4, 0), 0, {.wheel_pitch_m = 0.4});
  block.Stand();
  double load_n = 0;
  int count = 0;
  block.Drive(8, 1.0, 0, [&](const Vec3& force_n) { load_n += force_n.z(), ++count; });
  EXPECT_NEAR(load_n / count / (kMass_kg * kStandardGravity_mps2), 1, 0.01);
  EXPECT_GT(block.Rut_m(2.5), 1.4 * DrySandSinkage_m(1));
  EXPECT_LT(block.Rut_m(2.5), DrySandSinkage_m(2));
}

TEST(GearContact, StandingTrackSinksDeeperUnderItsRoadWheels) {
  Block block("size_m: [12, 4]\nsoil: gravel\n", Vec2(0, 0), 0, {.wheel_pitch_m = 0.4});
  block.Stand(2000);
  double under_m = 0, between_m = 0;
  for (const double x_m : {-0.6, -0.2, 0.2, 0.6}) under_m += block.Rut_m(x_m) / 4;
  for (const double x_m : {-0.4, 0.0, 0.4}) between_m += block.Rut_m(x_m) / 3;
  const SoilType& gravel = block.soil->soils()[0];
  const double pressure_pa = kMass_kg * kStandardGravity_mps2 / (2 * kWidth_m * kLength_m);
  EXPECT_GT(under_m, 1.2 * MeanSinkage_m(gravel, pressure_pa));
  EXPECT_LT(under_m, 1.01 * MeanSinkage_m(gravel, 2 * pressure_pa));
  EXPECT_LT(between_m, 0.3 * under_m);
}

TEST(GearContact, ThrustUnderRoadWheelsFollowsItsClosedForm) {
  // Wong 2008, ch. 2: with p = W / (b l) (1 + cos(2 n pi x / l)), peaks at both ends, and x = i
  // l/K, F = b l c (1 - (1 - e^-x) / x) + W tan phi (1 - (1 - e^-x) / x - (1 - e^-x) x / (x^2 + (2
  // n pi)^2)). Here valleys are at both ends: the last term has the other sign. n = 4.
  for (const auto& [slip, x] : std::vector<std::pair<double, double>>{
           {0.05, 3.2}, {0.10, 6.4}, {0.20, 12.8}, {0.40, 25.6}}) {
    const double e = 1 - std::exp(-x);
    const double even = 1 - e / x, peaks = e * x / (x * x + std::pow(8 * kPi, 2));
    const double expected_n =
        2 * kWidth_m * kLength_m * 1040 * even +
        kMass_kg * kStandardGravity_mps2 * std::tan(28 * kDeg) * (even + peaks);
    Block block(kDrySand, Vec2(-4.5, 0.1), 0, {.wheel_pitch_m = 0.4});
    block.Stand();
    double sum_n = 0;
    int count = 0, step = 0;
    block.Drive(5, 1.0 - slip, slip, [&](const Vec3&) {
      if (++step < 1500) return;
      sum_n += block.reaction.gear_traction_n[0] + block.reaction.gear_traction_n[1];
      ++count;
    });
    EXPECT_NEAR(sum_n / count / expected_n, 1, 0.05) << "slip " << slip;
  }
}

TEST(GearContact, TurningOnTheSpotIsResistedByFrictionAcrossTheTracks) {
  // Tracks roll as fast as they turn, so that the ground slides under them sideways alone:
  // M = (W tan phi + A c) L / 4. Shear needs some way to build up and to turn round in the
  // middle, so K is small here; the width adds some. The ends, which shove sand out of their way,
  // stand in a deeper ring than the middle and carry less.
  Block block(
      "size_m: [8, 8]\nsoil: s\n"
      "custom_soils: [{preset: tera:config/soils/sand.yaml, name: s, shear_modulus_m: 0.004}]\n",
      Vec2(0.2, -0.1), 0.3);
  block.Stand();
  const double rate_radps = 0.4, shoe_mps = rate_radps * kGauge_m / 2;
  block.motion.gear_rate_radps = {-shoe_mps / 0.25, shoe_mps / 0.25};  // the left one first
  block.links[0].w_WB_radps.z() = rate_radps;
  double moment_nm = 0;
  int count = 0;
  for (int k = 0; k < 2000; ++k) {
    block.ActAndFall();
    block.links[0].X_WB.translation().z() += kStep_s * block.links[0].v_WB_mps.z();
    block.links[0].X_WB.linear() =
        RotationFromRpy(0, 0, rate_radps * kStep_s) * block.links[0].X_WB.linear();
    if (k < 1000) continue;
    moment_nm += block.reaction.link_wrench[0].torque_W_nm.z();
    ++count;
  }
  const double weight_n = kMass_kg * kStandardGravity_mps2;
  const double strength_n = std::tan(28 * kDeg) * weight_n + 2 * kWidth_m * kLength_m * 1040;
  EXPECT_NEAR(moment_nm / count / (-strength_n * kLength_m / 4), 1, 0.15);
}

TEST(GearContact, GrousersOfASpinningTrackDigIn) {
  // Shoes that slip by s carry a layer as thick as the grousers are high: h s of soil for each
  // metre of width, out of L. The block sinks by h s / L, and the soil lies behind.
  Block block(kDrySand, Vec2(0, 0), 0, {.grouser_m = 0.03});
  block.Stand(2000);
  const double before_m = -block.links[0].X_WB.translation().z();
  block.motion.gear_rate_radps = {2, 2};
  for (int k = 0; k < 1000; ++k) block.ActAndSinkGently();  // 1 m of slip
  EXPECT_NEAR(-block.links[0].X_WB.translation().z() - before_m, 0.03 / kLength_m, 0.002);
  EXPECT_LT(block.Rut_m(-0.85), -0.05);  // a heap behind
  EXPECT_NEAR(block.Rut_m(0.9), 0, 1e-6);
  EXPECT_NEAR(block.soil->ledger().total_kg(), 0, 1e-9);
}

TEST(GearContact, SlipMakesAMovingTrackSinkDeeper) {
  // At 50 % slip each place loses a layer of h i / (1 - i) = h from the front to the rear, half of
  // it on average. The track comes to lie so.
  const auto depth_m = [](double grouser_m) {
    Block block(kDrySand, Vec2(-3, 0), 0, {.grouser_m = grouser_m});
    block.links[0].X_WB.linear() = RotationFromRpy(0, -grouser_m / kLength_m, 0);  // nose up
    block.Stand();
    block.Drive(5, 1.0, 0.5, kNothing);
    EXPECT_NEAR(block.soil->ledger().total_kg(), 0, 1e-9);
    return -block.links[0].X_WB.translation().z();
  };
  EXPECT_NEAR((depth_m(0.01) - depth_m(0)) / 0.005, 1, 0.3);
}

}  // namespace
}  // namespace tera
