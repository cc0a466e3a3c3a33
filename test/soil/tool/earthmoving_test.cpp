#include "soil/tool/earthmoving.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "core/units.h"

namespace tera {
namespace {

CuttingInput UprightFrictionless(double phi_deg) {
  CuttingInput in;
  in.depth_m = 1;
  in.rake_rad = 90 * kDeg;
  in.friction_rad = phi_deg * kDeg;
  in.density_kgpm3 = 1600;
  return in;
}

// A smooth upright wall is Rankine's passive case: force Kp rho g d^2 / 2 + 2 c d sqrt(Kp), slip
// plane at 45 deg - phi/2. For phi = 30 deg, Kp = 3.
TEST(Earthmoving, SmoothUprightBladeMeetsRankinesPassivePressure) {
  const CuttingForce force = Cut(UprightFrictionless(30));
  EXPECT_NEAR(force.wedge_rad / kDeg, 30.0, 0.03);
  const CuttingFactors n = CuttingFactorsAt(UprightFrictionless(30), 30 * kDeg);
  EXPECT_NEAR(n.n_gamma, 1.5, 0.0015);
  EXPECT_NEAR(n.n_c, 3.4641, 0.0035);
  EXPECT_NEAR(n.n_q, 3.0, 0.003);
  EXPECT_NEAR(force.total_n, 1.5 * 1600 * kStandardGravity_mps2, 1.5 * 16);
}

TEST(Earthmoving, RankineHoldsForEveryFrictionAngle) {
  for (const double phi_deg : {10.0, 20.0, 40.0}) {
    const double kp = std::pow(std::tan((45 + phi_deg / 2) * kDeg), 2);
    const CuttingForce force = Cut(UprightFrictionless(phi_deg));
    EXPECT_NEAR(force.wedge_rad / kDeg, 45 - phi_deg / 2, 0.05);
    const CuttingFactors n = CuttingFactorsAt(UprightFrictionless(phi_deg), force.wedge_rad);
    EXPECT_NEAR(n.n_gamma / (kp / 2), 1, 1e-3);
    EXPECT_NEAR(n.n_c / (2 * std::sqrt(kp)), 1, 1e-3);
  }
}

// phi 35, delta 20 deg, 0.5 m deep, 1 m wide, 1800 kg/m^3: worked with an independent program.
TEST(Earthmoving, WorkedTableOverRakeAngle) {
  const std::array<std::array<double, 2>, 5> table = {
      {{30, 7.57e3}, {45, 7.11e3}, {60, 8.03e3}, {75, 10.81e3}, {90, 18.37e3}}};
  for (const auto& [rake_deg, expected_n] : table) {
    CuttingInput in;
    in.depth_m = 0.5;
    in.rake_rad = rake_deg * kDeg;
    in.density_kgpm3 = 1800;
    in.friction_rad = 35 * kDeg;
    in.tool_friction_rad = 20 * kDeg;
    EXPECT_NEAR(PlaneCut(in).total_n / expected_n, 1, 0.005) << rake_deg;
  }
}

TEST(Earthmoving, GrowsWithDepthSlopeSpeedCohesionAndSurcharge) {
  CuttingInput base;
  base.width_m = 0.6;
  base.depth_m = 0.2;
  base.rake_rad = 40 * kDeg;
  base.density_kgpm3 = 1474;
  base.friction_rad = 40 * kDeg;
  base.tool_friction_rad = 20 * kDeg;
  base.cohesion_pa = 2100;
  const double force_n = Cut(base).total_n;
  // Order of magnitude of a compact excavator's bucket: one to fifteen kN.
  EXPECT_GT(force_n, 1e3);
  EXPECT_LT(force_n, 15e3);
  const auto with = [&](auto change) {
    CuttingInput in = base;
    change(&in);
    return Cut(in).total_n;
  };
  EXPECT_GT(with([](auto* in) { in->depth_m = 0.25; }), force_n);
  EXPECT_GT(with([](auto* in) { in->slope_rad = 10 * kDeg; }), force_n);
  EXPECT_LT(with([](auto* in) { in->slope_rad = -10 * kDeg; }), force_n);
  EXPECT_GT(with([](auto* in) { in->speed_mps = 1; }), force_n);
  EXPECT_GT(with([](auto* in) { in->cohesion_pa = 5000; }), force_n);
  EXPECT_GT(with([](auto* in) { in->surcharge_pa = 2000; }), force_n);
  EXPECT_GT(with([](auto* in) { in->flank_share = 1; }), force_n);
  EXPECT_EQ(with([](auto* in) { in->depth_m = 0; }), 0);
}

// Coulomb's passive pressure of ground that rises by i behind a smooth upright wall, by hand for
// phi = 30 deg. K_p = cos^2 phi / (1 - sqrt(sin phi sin(phi + i) / cos i))^2 (Das, Principles of
// Foundation Engineering, ch. 7).
TEST(Earthmoving, ASmoothUprightBladeOnASlopeMeetsCoulombsPassivePressure) {
  const std::array<std::array<double, 2>, 4> table = {
      {{-20, 1.548}, {-10, 2.204}, {10, 4.081}, {20, 5.737}}};
  for (const auto& [slope_deg, k_p] : table) {
    CuttingInput in = UprightFrictionless(30);
    in.slope_rad = slope_deg * kDeg;
    EXPECT_NEAR(PlaneCut(in).total_n / (k_p / 2 * 1600 * kStandardGravity_mps2), 1, 0.002)
        << slope_deg;
  }
}

// Luengo, Singh and Cannon's form in the frame of the surface. N_w = (cot beta - tan a) (cos a +
// sin a cot(beta + phi)) / 2D is that of the wedge ahead of the upright through the edge. N_c is
// that of its slip plane; the swept volume lies on the blade. A separate program worked it for 1 m
// of width, 0.3 m below the surface. Sand: phi 39, delta 19.5 deg, 1474 kg/m^3. Dirt: phi 40, delta
// 20 deg and c = 2100 Pa.
TEST(Earthmoving, SlopesAreLuengos) {
  struct Case {
    double cohesion_pa, rake_deg, slope_deg, expected_n;
  };
  const Case cases[] = {{0, 40, -20, 2002},    {0, 40, 0, 2257},      {0, 40, 20, 2538},
                        {0, 60, -20, 1597},    {0, 60, -10, 2091},    {0, 60, 10, 3410},
                        {0, 60, 20, 4494},     {2100, 40, -20, 3040}, {2100, 40, 20, 4468},
                        {2100, 60, -10, 3662}, {2100, 60, 20, 8714}};
  for (const Case& c : cases) {
    CuttingInput in;
    in.depth_m = 0.3;
    in.density_kgpm3 = 1474;
    in.cohesion_pa = c.cohesion_pa;
    in.friction_rad = (c.cohesion_pa > 0 ? 40 : 39) * kDeg;
    in.tool_friction_rad = in.friction_rad / 2;
    in.rake_rad = c.rake_deg * kDeg;
    in.slope_rad = c.slope_deg * kDeg;
    EXPECT_NEAR(PlaneCut(in).total_n / c.expected_n, 1, 0.002) << c.rake_deg << ' ' << c.slope_deg;
  }
}

// Where tool, slope and friction leave no room for a wedge, the force must not diverge at the pole
// of the wedge's equilibrium. It is a continuous function of the rake: a small step of the rake
// makes a small step of the force.
TEST(Earthmoving, StaysContinuousWhereNoWedgeFits) {
  for (const double slope_deg : {-25.0, 0.0, 10.0, 25.0}) {
    CuttingInput in;
    in.width_m = 1.55;
    in.depth_m = 0.3;
    in.density_kgpm3 = 1600;
    in.friction_rad = 32 * kDeg;
    in.tool_friction_rad = 22 * kDeg;
    in.cohesion_pa = 2000;
    in.slope_rad = slope_deg * kDeg;
    in.rake_rad = 5 * kDeg;
    double last_n = Cut(in).total_n;
    for (double rake_deg = 5.05; rake_deg < 175; rake_deg += 0.05) {
      in.rake_rad = rake_deg * kDeg;
      const double force_n = Cut(in).total_n;
      ASSERT_GT(force_n, last_n / 1.1) << slope_deg << ' ' << rake_deg;
      ASSERT_LT(force_n, last_n * 1.1) << slope_deg << ' ' << rake_deg;
      last_n = force_n;
    }
  }
}

// Beyond 45 deg a rough face that leans forwards pushes steeply down, and no spiral turns about it.
TEST(Earthmoving, IsFiniteForEverySoilThatMayBeStated) {
  for (double phi_deg = 0; phi_deg <= 89; phi_deg += 1) {
    for (double rake_deg = 5; rake_deg <= 175; rake_deg += 5) {
      for (const double share : {0.0, 0.5, 1.0}) {
        CuttingInput in = UprightFrictionless(phi_deg);
        in.depth_m = 0.1;
        in.rake_rad = rake_deg * kDeg;
        in.tool_friction_rad = share * in.friction_rad;
        in.cohesion_pa = 2000;
        in.surcharge_pa = 500;
        const CuttingForce force = Cut(in);
        ASSERT_TRUE(std::isfinite(force.draft_n) && std::isfinite(force.vertical_n))
            << phi_deg << " " << rake_deg << " " << share;
        ASSERT_GE(force.total_n, 0) << phi_deg << " " << rake_deg << " " << share;
        ASSERT_TRUE(std::isfinite(force.wedge_length_m)) << phi_deg << " " << rake_deg;
      }
    }
  }
}

}  // namespace
}  // namespace tera
