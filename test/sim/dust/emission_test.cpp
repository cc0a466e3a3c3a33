#include "sim/dust/emission.h"

#include <gtest/gtest.h>

#include <numeric>

namespace tera {
namespace {

double Sum(const DustMass& mass) { return std::accumulate(mass.begin(), mass.end(), 0.0); }

TEST(Emission, ADropAtTheReferenceWindAndMoistureIsTheTableOfAp42) {
  // Section 13.2.4, equation 1 at U = 2.2 m/s and M = 2 %. Both ratios are 1, which leaves k 0.0016
  // kg/t, with k = 0.053, 0.35 and 0.74 for particles below 2.5, 10 and 30 um.
  const DustMass of_tonne = DropEmission_kgpt(2.2, 2.0);
  EXPECT_NEAR(of_tonne[0], 0.053 * 0.0016, 1e-12);
  EXPECT_NEAR(of_tonne[0] + of_tonne[1], 0.35 * 0.0016, 1e-12);
  EXPECT_NEAR(Sum(of_tonne), 0.74 * 0.0016, 1e-12);
  // By hand: (4.4 / 2.2)^1.3 = 2.4623, (4 / 2)^1.4 = 2.6390.
  EXPECT_NEAR(Sum(DropEmission_kgpt(4.4, 2.0)) / Sum(of_tonne), 2.4623, 1e-4);
  EXPECT_NEAR(Sum(of_tonne) / Sum(DropEmission_kgpt(2.2, 4.0)), 2.6390, 1e-4);
}

TEST(Emission, TheDropEquationEndsWhereItsMeasurementsDo) {
  EXPECT_EQ(DropEmission_kgpt(0, 2), DropEmission_kgpt(0.6, 2));
  EXPECT_EQ(DropEmission_kgpt(20, 2), DropEmission_kgpt(6.7, 2));
  EXPECT_EQ(DropEmission_kgpt(3, 0), DropEmission_kgpt(3, 0.25));
  EXPECT_NEAR(DropHeightFactor(1.5), 1, 1e-12);
  EXPECT_EQ(DropHeightFactor(0), 0);
}

TEST(Emission, ARoadAtTheReferenceSiltAndWeightIsTheTableOfAp42) {
  // Section 13.2.2, equation 1a at s = 12 % and W = 3 short tons: 4.9 lb/VMT below 30 um, 1.5 below
  // 10 and 0.15 below 2.5. 1 lb/VMT is 281.9 g/VKT.
  const DustMass of_km = RoadEmission_kgpkm(12, 3 * 907.18474);
  EXPECT_NEAR(Sum(of_km), 4.9 * 0.2819, 1e-9);
  EXPECT_NEAR(of_km[0] + of_km[1], 1.5 * 0.2819, 1e-9);
  EXPECT_NEAR(of_km[0], 0.15 * 0.2819, 1e-9);
}

TEST(Emission, MoistRoadsEmitWhatTheFigureOfAp42Leaves) {
  EXPECT_EQ(MoistRoadShare(0.5), 1);
  EXPECT_NEAR(MoistRoadShare(1.0), 0.25, 1e-12);
  EXPECT_NEAR(MoistRoadShare(2.5), 0.05, 1e-12);
  EXPECT_LT(MoistRoadShare(10), 0.005);
}

TEST(Emission, WindErodesAboveTheThresholdOnly) {
  EXPECT_EQ(ErosionPotential_gpm2(1.0, 1.02), 0);
  // 58 0.5^2 + 25 0.5.
  EXPECT_NEAR(ErosionPotential_gpm2(1.52, 1.02), 27.0, 1e-9);
  // Section 13.2.5: u* = 0.053 u10 over a roughness of 0.5 cm.
  EXPECT_NEAR(FrictionVelocity_mps(10), 0.53, 0.005);
}

TEST(Emission, SaturatedSoilHoldsWhatItsPoresDo) {
  // Bank of 1325 kg/m^3: half of it is pores, with 0.5 t of water on 1.325 t of grains.
  EXPECT_NEAR(WaterByMass_percent(1, 1325), 100 * 0.5 / 1.325, 1e-9);
  EXPECT_NEAR(WaterByMass_percent(0.1, 1325), 10 * 0.5 / 1.325, 1e-9);
}

TEST(Emission, AQuartzGrainOfTenMicrometresFallsAsStokesSays) {
  // The usual example: about 8 mm/s for 10 um of 2650 kg/m^3 in air (Hinds, Aerosol Technology,
  // table 3.2 has 3.06e-3 m/s for unit density).
  EXPECT_NEAR(StokesSpeed_mps(10e-6, 1000), 3.06e-3, 0.06e-3);
  EXPECT_NEAR(StokesSpeed_mps(10e-6, 2650), 2.65 * 3.06e-3, 0.2e-3);
}

}  // namespace
}  // namespace tera
