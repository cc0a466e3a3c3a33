#include "soil/tool/curved_slip.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "core/units.h"
#include "soil/tool/earthmoving.h"

namespace tera {
namespace {

/// A metre of upright blade a metre deep in level ground.
CuttingInput Wall(double phi_deg, double delta_deg) {
  CuttingInput in;
  in.depth_m = 1;
  in.rake_rad = 90 * kDeg;
  in.density_kgpm3 = 1600;
  in.friction_rad = phi_deg * kDeg;
  in.tool_friction_rad = delta_deg * kDeg;
  return in;
}

/// K_p: P over rho g d^2 / 2.
double Kp(const CuttingInput& in) {
  return Cut(in).total_n /
         (in.width_m * in.density_kgpm3 * kStandardGravity_mps2 * in.depth_m * in.depth_m / 2);
}

// Caquot and Kerisel's K_p of upright walls and level ground by NAVFAC DM-7.02 (1986), fig. 6: for
// delta = phi, and its reduction R for less wall friction. A plane slip surface has 10.1, 23.0 and
// 92.6 for delta = phi.
TEST(CurvedSlip, PassivePressureIsCaquotAndKerisels) {
  struct Row {
    double phi_deg, k_p;
    std::array<double, 4> reduction;  // delta / phi = 0, 0.3, 0.7, 1
  };
  const std::array<double, 4> parts = {0, 0.3, 0.7, 1};
  const Row rows[] = {{30, 6.5, {0.467, 0.627, 0.878, 1}},
                      {35, 10.5, {0.362, 0.536, 0.836, 1}},
                      {40, 18.0, {0.262, 0.439, 0.783, 1}}};
  for (const Row& row : rows) {
    for (std::size_t k = 0; k < parts.size(); ++k) {
      // An upper bound, which is loosest where soil rubs on soil (Soubra and Macuh 2002). The
      // tables lie higher than strict upper bounds for less friction: test/judges/blade_limit.py
      // has 9.85 at 40 and 20 deg, they have 10.7.
      const double within = parts[k] == 1 ? 0.12 : 0.09;
      EXPECT_NEAR(Kp(Wall(row.phi_deg, parts[k] * row.phi_deg)) / (row.k_p * row.reduction[k]), 1,
                  within)
          << row.phi_deg << ' ' << parts[k];
    }
  }
}

TEST(CurvedSlip, WithoutWallFrictionThePassivePressureIsRankines) {
  for (const double phi_deg : {20.0, 30.0, 40.0}) {
    const double rankine = std::pow(std::tan((45 + phi_deg / 2) * kDeg), 2);
    const double force_n = CurvedSlipForce_n(Wall(phi_deg, 0));
    EXPECT_NEAR(force_n / (rankine / 2 * 1600 * kStandardGravity_mps2), 1, 0.002) << phi_deg;
  }
}

// Weightless soil at a perfectly rough wall. By Prandtl's slip lines a surcharge presses across the
// wall with K = (1 + sin phi) exp(2 theta tan phi), 2 theta = 90 deg + phi (Lancellotta 2002, eq.
// 20, for delta = phi). By corresponding states cohesion gives c cot phi (K - 1), where adhesion is
// as high. Both are lower bounds for a surface of failure.
TEST(CurvedSlip, SurchargeAndCohesionOfSoilOnSoilAreNoLessThanPrandtls) {
  for (const double phi_deg : {20.0, 30.0, 40.0}) {
    const double phi = phi_deg * kDeg;
    const double k = (1 + std::sin(phi)) * std::exp((kPi / 2 + phi) * std::tan(phi));
    CuttingInput in = Wall(phi_deg, phi_deg);
    in.density_kgpm3 = 0;
    in.surcharge_pa = 1000;
    const double surcharge = CurvedSlipForce_n(in) * std::cos(phi) / (1000 * k);
    in.surcharge_pa = 0;
    in.cohesion_pa = in.adhesion_pa = 1000;
    const double cohesion =
        CurvedSlipForce_n(in) * std::cos(phi) / (1000 * (k - 1) / std::tan(phi));
    for (const double ratio : {surcharge, cohesion}) {
      EXPECT_GT(ratio, 1) << phi_deg;
      EXPECT_LT(ratio, 1.16) << phi_deg;
    }
  }
}

// A spiral that hardly turns is a plane: each term of the earthmoving equation, on level and on
// sloping ground.
TEST(CurvedSlip, WithoutATurnItIsTheEarthmovingEquation) {
  CuttingInput base;
  base.width_m = 0.6;
  base.depth_m = 0.3;
  base.rake_rad = 70 * kDeg;
  base.friction_rad = 32 * kDeg;
  base.tool_friction_rad = 15 * kDeg;
  for (const double slope_deg : {-15.0, 0.0, 12.0}) {
    base.slope_rad = slope_deg * kDeg;
    const double wedge_rad = 24 * kDeg, d = base.depth_m;
    const CuttingFactors n = CuttingFactorsAt(base, wedge_rad);
    const auto expect = [&](double force_n, auto change) {
      CuttingInput in = base;
      change(&in);
      EXPECT_NEAR(CurvedSlipForceAt_n(in, wedge_rad, 1e-4) / (in.width_m * force_n), 1, 1e-3)
          << slope_deg;
    };
    expect(1500 * kStandardGravity_mps2 * d * d * n.n_gamma,
           [](auto* in) { in->density_kgpm3 = 1500; });
    expect(2000 * d * n.n_c, [](auto* in) { in->cohesion_pa = 2000; });
    expect(2000 * d * n.n_q, [](auto* in) { in->surcharge_pa = 2000; });
    expect(5000 * d * n.n_c + 2000 * d * n.n_a,
           [](auto* in) { in->cohesion_pa = 5000, in->adhesion_pa = 2000; });
    expect(1500 * d * (kStandardGravity_mps2 * d * n.n_gamma + 4 * n.inertia),
           [](auto* in) { in->density_kgpm3 = 1500, in->speed_mps = 2; });
    // Two flanks of d^2 / (tan beta - tan slope) / 2 with c each, over the width and the length of
    // the slip plane.
    const double ahead = 1 / (std::tan(wedge_rad) - std::tan(base.slope_rad));
    const double flanks_pa = 2000 * d * ahead * d / (ahead * d / std::cos(wedge_rad)) / 0.6;
    expect((2000 + flanks_pa) * d * n.n_c,
           [](auto* in) { in->cohesion_pa = 2000, in->flank_share = 1; });
  }
}

// With more wall friction, and with a blade that leans more, the force grows without a step. It
// never exceeds that of soil on soil at an upright face.
TEST(CurvedSlip, ForceGrowsSteadilyWithWallFrictionAndLean) {
  for (const double phi_deg : {13.0, 30.0, 44.0}) {
    CuttingInput in = Wall(phi_deg, 0);
    in.cohesion_pa = 2000;
    double last_n = Cut(in).total_n;
    for (double delta_deg = 0; delta_deg <= phi_deg; delta_deg += 0.1) {
      in.tool_friction_rad = delta_deg * kDeg;
      const double force_n = Cut(in).total_n;
      ASSERT_GT(force_n, 0.999 * last_n) << phi_deg << ' ' << delta_deg;
      ASSERT_LT(force_n, 1.03 * last_n) << phi_deg << ' ' << delta_deg;
      last_n = force_n;
    }
    const double most_n = last_n;
    in.tool_friction_rad = phi_deg / 2 * kDeg;
    last_n = 0;
    for (double rake_deg = 60; rake_deg < 175; rake_deg += 0.1) {
      in.rake_rad = rake_deg * kDeg;
      const double force_n = Cut(in).total_n;
      ASSERT_GT(force_n, 0.999 * last_n) << phi_deg << ' ' << rake_deg;
      ASSERT_LT(force_n, 1.01 * most_n) << phi_deg << ' ' << rake_deg;
      last_n = force_n;
    }
  }
}

}  // namespace
}  // namespace tera
