#include "soil/terramechanics.h"

#include <gtest/gtest.h>

#include "core/units.h"

namespace tera {
namespace {

constexpr double kWeight_n = 39240, kWidth_m = 0.3, kLength_m = 1.6;  // both tracks carry it

SoilType DrySand() {
  SoilType soil;
  soil.k_c_npm_n1 = 990;
  soil.k_phi_npm_n2 = 1528430;
  soil.sinkage_exponent = 1.1;
  soil.cohesion_pa = 1040;
  soil.friction_angle_rad = 28 * kDeg;
  soil.shear_modulus_m = 0.025;
  return soil;
}

SoilType SandyLoam11() {
  SoilType soil = DrySand();
  soil.k_c_npm_n1 = 52530;
  soil.k_phi_npm_n2 = 1127970;
  soil.sinkage_exponent = 0.9;
  soil.cohesion_pa = 4830;
  soil.friction_angle_rad = 20 * kDeg;
  return soil;
}

void ExpectTrack(const SoilType& soil, double sinkage_m, double resistance_n,
                 const std::vector<std::pair<double, double>>& thrust_n) {
  const double pressure_pa = kWeight_n / (2 * kWidth_m * kLength_m);
  const double z_m = BekkerSinkage_m(soil, kWidth_m, pressure_pa);
  EXPECT_NEAR(z_m / sinkage_m, 1, 0.01);
  EXPECT_NEAR(BekkerPressure_pa(soil, kWidth_m, z_m) / pressure_pa, 1, 1e-9);
  EXPECT_NEAR(2 * CompactionResistance_n(soil, kWidth_m, z_m), resistance_n, 5);
  for (const auto& [slip, thrust] : thrust_n) {
    const double both_n = 2 * TrackThrust_n(soil, kWidth_m, kLength_m, kWeight_n / 2, slip);
    EXPECT_NEAR(both_n / thrust, 1, 0.01) << slip;
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

}  // namespace
}  // namespace tera
