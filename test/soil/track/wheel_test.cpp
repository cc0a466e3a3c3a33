#include <fmt/format.h>
#include <gtest/gtest.h>

#include "soil/track/wheel_bench.h"
#include "soil/track/wong_reece.h"

namespace tera {
namespace {

using namespace testing_soil;

/// The rover's wheel and regolith simulant of Ishigami, Miwa, Nagatani and Yoshida 2007, as others
/// quote them. Their K is another along and across the wheel and grows with the slip angle; here it
/// is that along the wheel, straight ahead.
constexpr RigidWheel kRoverWheel{.radius_m = 0.092, .width_m = 0.107, .load_n = 64.68};
constexpr WheelSoil kSimulant{.cohesion_pa = 800,
                              .friction_rad = 37.2 * kDeg,
                              .k_c = 1370,
                              .k_phi = 814000,
                              .exponent = 1.0,
                              .density_kgpm3 = 1600,
                              .shear_m = 0.036};

/// A wheel of the size of Wong and Reece's, 49.4 by 6 inches, on the dry sand of Wong 2008.
constexpr RigidWheel kLargeWheel{.radius_m = 0.627, .width_m = 0.152, .load_n = 2000};
constexpr WheelSoil kSand{.cohesion_pa = 1040,
                          .friction_rad = 28 * kDeg,
                          .k_c = 990,
                          .k_phi = 1528430,
                          .exponent = 1.1,
                          .density_kgpm3 = 1474,
                          .shear_m = 0.018};

/// Sinkage within 20 %, drawbar pull within a quarter of the load.
void ExpectWongReece(const RigidWheel& wheel, const WheelSoil& soil, double slip) {
  const WheelTest test = RunWheel(wheel, soil.Yaml(), slip);
  const WheelForces expected = WongReece(wheel, soil, slip);
  EXPECT_NEAR(test.sinkage_m / expected.sinkage_m, 1, 0.20) << "slip " << slip;
  EXPECT_NEAR(test.drawbar_n / wheel.load_n, expected.drawbar_n / wheel.load_n, 0.25)
      << "slip " << slip;
  const std::string name = fmt::format("slip_{:.0f}_", 100 * slip);
  const auto record = [&](const char* what, double here, double there) {
    testing::Test::RecordProperty(name + what, fmt::format("{:.3f} expected {:.3f}", here, there));
  };
  record("sinkage_mm", 1e3 * test.sinkage_m, 1e3 * expected.sinkage_m);
  record("drawbar_over_load", test.drawbar_n / wheel.load_n, expected.drawbar_n / wheel.load_n);
  record("torque_over_load", test.traction_n / wheel.load_n, expected.traction_n / wheel.load_n);
}

TEST(Wheel, SmallOneSinksAndPullsAsWongAndReeceSay) {
  for (const double slip : {0.0, 0.3, 0.6}) ExpectWongReece(kRoverWheel, kSimulant, slip);
}

TEST(Wheel, LargeOneSinksAndPullsAsWongAndReeceSay) {
  for (const double slip : {0.0, 0.2, 0.6}) ExpectWongReece(kLargeWheel, kSand, slip);
}

TEST(Wheel, GrousersDoNotBuryItAtGreatSlip) {
  RigidWheel wheel = kRoverWheel;
  wheel.grouser_m = 0.01;
  ExpectWongReece(wheel, kSimulant, 0.9);
}

TEST(Wheel, SlipMakesItSinkThreeToSevenTimesAsDeepAsItStands) {
  // Ding et al. 2010, J. Cent. South Univ. Technol. 17, abstract: three lugged wheels on lunar soil
  // simulant, slip 0.6. Their wheels' and soil's figures are not at hand.
  const WheelTest test = RunWheel(kRoverWheel, kSimulant.Yaml(), 0.6);
  EXPECT_GT(test.sinkage_m / test.still_m, 3);
  EXPECT_LT(test.sinkage_m / test.still_m, 7);
}

TEST(Wheel, SkidMakesItSinkDeeperAndDragMore) {
  const WheelTest rolls = RunWheel(kRoverWheel, kSimulant.Yaml(), 0);
  const WheelTest skids = RunWheel(kRoverWheel, kSimulant.Yaml(), -0.25);
  EXPECT_GT(skids.sinkage_m, 1.1 * rolls.sinkage_m);
  EXPECT_LT(skids.drawbar_n, rolls.drawbar_n);
  EXPECT_GT(skids.drawbar_n, -kRoverWheel.load_n);
}

TEST(Wheel, SideForceGrowsWithTheSlipAngleAsIshigamiSays) {
  for (const double slip_angle_deg : {5.0, 15.0, 30.0, 45.0}) {
    const double slip_angle_rad = slip_angle_deg * kDeg;
    WheelSoil soil = kSimulant;
    soil.shear_m = 0.013 + 0.020 * slip_angle_rad;  // across the wheel, see kSimulant
    const WheelTest test = RunWheel(kRoverWheel, soil.Yaml(), 0, slip_angle_rad);
    const double expected_n = WongReece(kRoverWheel, soil, 0, slip_angle_rad).side_n;
    EXPECT_NEAR(test.side_n / expected_n, 1, 0.25) << slip_angle_deg << " deg";
    RecordProperty(fmt::format("side_over_load_{:.0f}_deg", slip_angle_deg),
                   fmt::format("{:.3f} expected {:.3f}", test.side_n / kRoverWheel.load_n,
                               expected_n / kRoverWheel.load_n));
  }
}

TEST(Wheel, StraightAcrossMeetsTheStrengthBelowAndThePassivePressureBeside) {
  // A locked wheel, sunk as it stands: c A + W tan phi, and Hegedus along its chord, the mean of
  // whose depth is 2/3 of the deepest and of whose depth squared 8/15.
  WheelSoil soil = kSimulant;
  soil.shear_m = 0.013;
  const WheelTest test = RunWheel(kRoverWheel, soil.Yaml(), 0, 90 * kDeg);
  const double r = kRoverWheel.radius_m, z = test.sinkage_m;
  const double chord_m = 2 * std::sqrt(2 * r * z - z * z);
  const double strength_n = soil.cohesion_pa * kRoverWheel.width_m * chord_m +
                            kRoverWheel.load_n * std::tan(soil.friction_rad);
  WheelSoil cohesionless = soil;
  cohesionless.cohesion_pa = 0;
  const double weight_npm = HegedusResistance_npm(cohesionless, z);
  const double cohesion_npm = HegedusResistance_npm(soil, z) - weight_npm;
  const double face_n = chord_m * (2.0 / 3 * cohesion_npm + 8.0 / 15 * weight_npm);
  EXPECT_NEAR(test.side_n / (strength_n + face_n), 1, 0.1);
  EXPECT_GT(test.side_n, strength_n);
}

}  // namespace
}  // namespace tera
