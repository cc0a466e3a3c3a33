#include "soil/track/terramechanics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "core/units.h"
#include "soil/track/plate.h"

namespace tera {
namespace {

constexpr double kWeight_n = 39240, kWidth_m = 0.3, kLength_m = 1.6;  // both tracks carry it

SoilType DrySand() {
  SoilType soil;
  soil.k_c_npm_n1 = 990;
  soil.k_phi_npm_n2 = 1528430;
  soil.sinkage_exponent = 1.1;
  soil.shear_cohesion_pa = 1040;
  soil.shear_friction_rad = 28 * kDeg;
  soil.shear_modulus_m = 0.025;
  return soil;
}

SoilType SandyLoam11() {
  SoilType soil = DrySand();
  soil.k_c_npm_n1 = 52530;
  soil.k_phi_npm_n2 = 1127970;
  soil.sinkage_exponent = 0.9;
  soil.shear_cohesion_pa = 4830;
  soil.shear_friction_rad = 20 * kDeg;
  return soil;
}

void ExpectTrack(const SoilType& soil, double sinkage_m, double resistance_n,
                 const std::vector<std::pair<double, double>>& thrust_n) {
  const double pressure_pa = kWeight_n / (2 * kWidth_m * kLength_m);
  EXPECT_NEAR(BekkerPressure_pa(soil, kWidth_m, sinkage_m) / pressure_pa, 1, 0.005);
  EXPECT_NEAR(2 * kWidth_m * BekkerWork_jpm2(soil, kWidth_m, sinkage_m), resistance_n, 6);
  const double strength_n = 2 * kWidth_m * kLength_m * soil.shear_cohesion_pa +
                            kWeight_n * std::tan(soil.shear_friction_rad);
  const int parts = 1000;
  for (const auto& [slip, thrust] : thrust_n) {
    double mobilised = 0;
    for (int k = 0; k < parts; ++k) {
      mobilised += ShearMobilisation(soil, slip * kLength_m * (k + 0.5) / parts) / parts;
    }
    EXPECT_NEAR(strength_n * mobilised / thrust, 1, 0.01) << slip;
  }
}

// Closed form by hand for the two soils of Wong 2008, table 2.3; resistances are given to 10 N.
TEST(Terramechanics, TrackOnDrySand) {
  ExpectTrack(DrySand(), 0.0371, 430, {{0.05, 15310}, {0.10, 18450}, {0.20, 20150}, {0.40, 21010}});
}

TEST(Terramechanics, TrackOnSandyLoam) {
  ExpectTrack(SandyLoam11(), 0.0214, 280,
              {{0.05, 13250}, {0.10, 15970}, {0.20, 17440}, {0.40, 18180}});
}

// By hand: tan phi' = 2/3 tan 30 = 0.3849, phi' = 21.05 deg, N_q = e^(0.3849 pi) tan^2 55.53
// = 7.106, N_c = 6.106 / 0.3849 = 15.86, N_g = 2 x 8.106 x 0.3849 = 6.240; K_pg = 33.42 x 0.8710
// = 29.11, K_pc = 15.48 x 0.8710 = 13.48.
TEST(Terramechanics, BulldozedSoilResistsAsBekkerSays) {
  SoilType soil;
  soil.bank_density_kgpm3 = 1500;
  soil.shear_friction_rad = 30 * kDeg;
  const double weight_n = 0.3 * 0.5 * 1500 * 9.80665 * 29.11;  // for z = 1 m
  EXPECT_NEAR(BulldozingResistance_n(soil, 0.3, 0.1) / (0.01 * weight_n), 1, 0.002);
  EXPECT_NEAR(BulldozingResistance_n(soil, 0.3, 0.2) / (0.04 * weight_n), 1, 0.002);
  soil.shear_cohesion_pa = 2000;
  const double cohesion_n = 0.3 * 0.67 * 2000 * 13.48;
  EXPECT_NEAR(BulldozingResistance_n(soil, 0.3, 0.1) / (0.01 * weight_n + 0.1 * cohesion_n), 1,
              0.002);
  EXPECT_EQ(BulldozingResistance_n(soil, 0.3, -0.1), 0);
}

// By hand: phi 30 deg, X = 30 deg: cot X = tan(X + phi) = 1.7321, 2 x 1.7321 = 3.4641 times 1 m of
// cohesion 2 kPa, or of weight 14.71 kN/m^3 / 2 times 1.7321 + 3 x 0.5774 = 3.4641: 88.26 kN/m.
TEST(Terramechanics, SoilBesideASunkFaceResistsAsHegedusSays) {
  SoilType soil;
  soil.bank_density_kgpm3 = 1500;
  soil.shear_friction_rad = 30 * kDeg;
  EXPECT_NEAR(PushedFace(soil).Resistance_npm(1) / 88260, 1, 0.001);
  EXPECT_NEAR(PushedFace(soil).Resistance_npm(0.1) / 882.6, 1, 0.001);
  soil.shear_cohesion_pa = 2000;
  EXPECT_NEAR((PushedFace(soil).Resistance_npm(0.1) - 882.6) / 692.8, 1, 0.001);
  EXPECT_EQ(PushedFace(soil).Resistance_npm(-0.1), 0);
}

TEST(Terramechanics, APlateBearsWhatItsPressureSays) {
  // Bounds by the logarithm and single precision leave no pressure to the wrong side.
  const Stream random(5, "test/bears");
  ContactPatch patch;
  patch.length_m = 0.2;
  patch.width_m = 0.3;
  for (int trial = 0; trial < 20000; ++trial) {
    SoilType soil;
    soil.k_phi_npm_n2 = 1e6;
    soil.sinkage_exponent = 0.1 + 1.9 * random.Uniform(trial, 1);
    const tera::Plate plate(soil, patch);
    const double z_m = std::pow(10, -6 * random.Uniform(trial, 2));
    const double least_pa = plate.Pressure_pa(z_m);
    const double off = std::pow(10, -8 * random.Uniform(trial, 3));
    EXPECT_TRUE(plate.Bears((1 - off) * least_pa, z_m)) << z_m << " " << off;
    EXPECT_FALSE(plate.Bears((1 + off) * least_pa, z_m)) << z_m << " " << off;
  }
}

TEST(Terramechanics, PressureUnderRoadWheelsHasPeaksAndTheSameMean) {
  ContactPatch patch;
  EXPECT_EQ(PressureShare(patch, 0.03), 1);
  patch.wheel_pitch_m = 0.4;
  patch.past_wheel_m = -0.1;
  EXPECT_NEAR(PressureShare(patch, 0.1), 2, 1e-12);   // under the axle
  EXPECT_NEAR(PressureShare(patch, -0.1), 0, 1e-12);  // half-way to the next
  double mean = 0;
  for (int k = 0; k < 40; ++k) mean += PressureShare(patch, 0.01 * k) / 40;
  EXPECT_NEAR(mean, 1, 1e-12);
}

}  // namespace
}  // namespace tera
