#include "soil/tool/slip_ahead.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/units.h"

namespace tera {
namespace {

/// A metre of upright blade in soil of one density.
CuttingForce Upright(const GroundAhead& ground, double phi_deg, double delta_deg,
                     double cohesion_pa = 0) {
  CuttingInput in;
  in.depth_m = ground.depth_m();
  in.rake_rad = 90 * kDeg;
  in.density_kgpm3 = 1600;
  in.friction_rad = phi_deg * kDeg;
  in.tool_friction_rad = delta_deg * kDeg;
  SoilAhead soil;
  soil.firm_density_kgpm3 = soil.loose_density_kgpm3 = in.density_kgpm3;
  soil.firm_cohesion_pa = cohesion_pa;
  soil.blade_m = 10;
  return CutAhead(in, ground, soil);
}

/// A slope whose upper `loose_m` lies loose.
GroundAhead Slope(double depth_m, double slope_rad, double loose_m, double reach_m) {
  GroundAhead ground;
  for (int k = 0; k < GroundAhead::kPlaces; ++k) {
    const double part = k / (GroundAhead::kPlaces - 1.0);
    ground.x_m[k] = reach_m * part * part;
    ground.top_m[k] = depth_m + std::tan(slope_rad) * ground.x_m[k];
    ground.firm_m[k] = ground.top_m[k] - loose_m;
  }
  return ground;
}

struct Corner {
  double x_m, z_m;
};
/// Ground between corners, loose above a level.
GroundAhead Between(const std::vector<Corner>& corners, double firm_m) {
  GroundAhead ground;
  for (int k = 0; k < GroundAhead::kPlaces; ++k) {
    const double x_m = corners.back().x_m * std::pow(k / (GroundAhead::kPlaces - 1.0), 1.5);
    std::size_t n = 0;
    while (n + 2 < corners.size() && corners[n + 1].x_m < x_m) ++n;
    const Corner &a = corners[n], &b = corners[n + 1];
    ground.x_m[k] = x_m;
    ground.top_m[k] = a.z_m + std::min(1.0, (x_m - a.x_m) / (b.x_m - a.x_m)) * (b.z_m - a.z_m);
    ground.firm_m[k] = std::min(firm_m, ground.top_m[k]);
  }
  return ground;
}

double Section_m2(const GroundAhead& ground) {
  double m2 = 0;
  for (int k = 1; k < GroundAhead::kPlaces; ++k) {
    m2 += 0.5 * (ground.x_m[k] - ground.x_m[k - 1]) *
          (std::max(0.0, ground.top_m[k]) + std::max(0.0, ground.top_m[k - 1]));
  }
  return m2;
}

constexpr double kWeight_npm3 = 1600 * kStandardGravity_mps2;

// K_p by the linear program of test/judges/blade_limit.py. It finds the least upper bound over
// patterns of slip lines between the points of a grid, a little high because grids are coarse. A
// plane slip surface has 11.8, 26.6 and 65 on the last three slopes.
TEST(SlipAhead, SlopesHaveThePassivePressureOfALimitAnalysis) {
  struct Row {
    double phi_deg, delta_deg, slope_deg, k_p;
  };
  for (const Row& row : {Row{30, 0, 0, 3.00}, Row{30, 0, 10, 3.99}, Row{30, 0, 20, 5.13},
                         Row{30, 15, 0, 4.66}, Row{30, 15, 10, 6.56}, Row{30, 15, 20, 8.80},
                         Row{40, 20, 0, 9.85}, Row{40, 20, 10, 15.44}, Row{40, 20, 20, 23.55}}) {
    const GroundAhead ground = Slope(1, row.slope_deg * kDeg, 0, 10);
    EXPECT_NEAR(Upright(ground, row.phi_deg, row.delta_deg).total_n / (kWeight_npm3 / 2) / row.k_p,
                0.98, 0.025)
        << row.phi_deg << ' ' << row.delta_deg << ' ' << row.slope_deg;
  }
}

// Caquot and Kerisel's K_p at 40 deg and half of it on the blade, by quoted tables. It is about 10
// for level ground, and 16 and 27 for ground that rises by 10 and 20 deg.
TEST(SlipAhead, RisingGroundIsNotTheEndlessPlanes) {
  const auto k_p = [](double slope_deg) {
    return Upright(Slope(1, slope_deg * kDeg, 0, 10), 40, 20).total_n / (kWeight_npm3 / 2);
  };
  EXPECT_NEAR(k_p(0) / 10, 1, 0.05);
  EXPECT_NEAR(k_p(10) / 16, 1, 0.1);
  EXPECT_NEAR(k_p(20) / 27, 1, 0.2);
}

// A berm that is pushed at its foot or in its flank takes no more than sliding all of it. A smooth
// blade needs W tan phi. Friction on the blade presses the berm down: W sin(phi) / sin(90 deg +
// delta + phi) along the blade's force.
TEST(SlipAhead, ABermTakesNoMoreThanSlidingIt) {
  for (const double at_blade_m : {0.05, 0.3, 0.6}) {
    for (const double high_m : {0.6, 0.9}) {
      const double rise_m = (high_m - at_blade_m) / std::tan(35 * kDeg);
      const double fall_m = high_m / std::tan(35 * kDeg);
      const GroundAhead ground =
          Between({{0, at_blade_m}, {rise_m, high_m}, {rise_m + fall_m, 0}, {4, 0}}, 0);
      const double weight_n = kWeight_npm3 * Section_m2(ground);
      EXPECT_LE(Upright(ground, 40, 0).draft_n, 1.01 * weight_n * std::tan(40 * kDeg))
          << at_blade_m << ' ' << high_m;
      EXPECT_LE(Upright(ground, 40, 20).draft_n,
                1.01 * weight_n * std::sin(40 * kDeg) * std::cos(20 * kDeg) / std::sin(150 * kDeg))
          << at_blade_m << ' ' << high_m;
    }
  }
}

// A heap of loose soil on a cut of 3 cm slides on the firm soil. Its force lies between the
// weight's friction alone and that with the chip below it. The chip's least force under the heap's
// weight is known by itself.
TEST(SlipAhead, AHeapBeforeAThinCutSlides) {
  const GroundAhead heap = Between({{0, 0.53}, {0.71, 0.03}, {2.5, 0.03}}, 0.03);
  const double weight_n = kWeight_npm3 * Section_m2(heap);
  const double draft_n = Upright(heap, 40, 20, 2100).draft_n;
  EXPECT_GT(draft_n, 0.8 * weight_n * std::tan(40 * kDeg));
  EXPECT_LT(draft_n, 2.5 * weight_n * std::tan(40 * kDeg));
}

// Drafts of the same program, in N/m. One is for a berm of 0.6 m at 35 deg, the blade 0.3 m deep in
// its near flank. The others are for heaps at 35 deg, of 0.5 m on a cut of 3 cm and of 0.25 m on
// one of 0.2 m, with and without 2100 Pa of cohesion below them.
TEST(SlipAhead, BermsAndHeapsHaveTheDraftOfALimitAnalysis) {
  const double t = std::tan(35 * kDeg);
  const std::vector<Corner> berm = {{0, 0.3}, {0.3 / t, 0.6}, {0.85 / t, 0.05}};
  const auto heap = [&](double depth_m, double heap_m) {
    return Between({{0, depth_m + heap_m}, {heap_m / t, depth_m}, {2.5, depth_m}}, depth_m);
  };
  EXPECT_NEAR(Upright(Between(berm, 0.6), 40, 0).draft_n / 5990, 1, 0.1);
  EXPECT_NEAR(Upright(Between(berm, 0.6), 40, 20).draft_n / 8804, 1, 0.1);
  EXPECT_NEAR(Upright(heap(0.03, 0.5), 40, 20, 2100).draft_n / 5515, 1, 0.1);
  EXPECT_NEAR(Upright(heap(0.2, 0.25), 40, 20, 2100).draft_n / 8628, 1, 0.12);
  EXPECT_NEAR(Upright(heap(0.2, 0.25), 40, 20).draft_n / 4701, 1, 0.1);
}

TEST(SlipAhead, LevelGroundIsTheEarthmovingEquationsAtFlatRakes) {
  CuttingInput in;
  in.width_m = 0.6;
  in.depth_m = 0.3;
  in.density_kgpm3 = 1474;
  in.friction_rad = 40 * kDeg;
  in.tool_friction_rad = 20 * kDeg;
  in.cohesion_pa = 2100;
  in.adhesion_pa = 300;
  in.speed_mps = 1;
  in.flank_share = 1;
  SoilAhead soil;
  soil.firm_density_kgpm3 = soil.loose_density_kgpm3 = in.density_kgpm3;
  soil.firm_cohesion_pa = in.cohesion_pa;
  soil.blade_m = 10;
  for (double rake_deg = 15; rake_deg <= 70; rake_deg += 5) {
    in.rake_rad = rake_deg * kDeg;
    const GroundAhead ground = Slope(in.depth_m, 0, 0, 3);
    EXPECT_NEAR(CutAhead(in, ground, soil).draft_n / PlaneCut(in).draft_n, 1, 0.01) << rake_deg;
  }
}

// In small steps of the rake, of friction and of the ground's slope the force moves in small steps.
TEST(SlipAhead, IsSteadyOverRakeFrictionAndSlope) {
  CuttingInput in;
  in.density_kgpm3 = 1600;
  SoilAhead soil;
  soil.firm_density_kgpm3 = soil.loose_density_kgpm3 = in.density_kgpm3;
  soil.firm_cohesion_pa = in.cohesion_pa = 2000;
  soil.blade_m = 1;
  in.depth_m = 0.3;
  for (const double slope_deg : {-20.0, 0.0, 20.0, 35.0}) {
    const GroundAhead ground = Slope(in.depth_m, slope_deg * kDeg, 0.1, 3);
    for (const double phi_deg : {15.0, 32.0, 44.0}) {
      in.friction_rad = phi_deg * kDeg;
      in.tool_friction_rad = 0.6 * in.friction_rad;
      double last_n = 0;
      for (double rake_deg = 20; rake_deg <= 150; rake_deg += 0.25) {
        in.rake_rad = rake_deg * kDeg;
        const double force_n = CutAhead(in, ground, soil).total_n;
        ASSERT_GT(force_n, 0) << slope_deg << ' ' << phi_deg << ' ' << rake_deg;
        if (last_n > 0) {
          ASSERT_NEAR(force_n / last_n, 1, 0.04) << slope_deg << ' ' << phi_deg << ' ' << rake_deg;
        }
        last_n = force_n;
      }
    }
  }
}

}  // namespace
}  // namespace tera
