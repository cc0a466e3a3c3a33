#include "soil/tool/layered_cut.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "core/random.h"
#include "core/units.h"

namespace tera {
namespace {

CutLayer Soil(double thickness_m, double friction_deg, double cohesion_pa,
              double density_kgpm3 = 1600) {
  return {.thickness_m = thickness_m,
          .density_kgpm3 = density_kgpm3,
          .friction_rad = friction_deg * kDeg,
          .tool_friction_rad = 0.5 * friction_deg * kDeg,
          .cohesion_pa = cohesion_pa,
          .adhesion_pa = 0};
}

/// Means by thickness, of friction that of its tangent.
CuttingInput Mean(const std::vector<CutLayer>& layers, CuttingInput in) {
  double all_m = 0, kgpm2 = 0, friction_m = 0, tool_m = 0, cohesion_pam = 0;
  for (const CutLayer& layer : layers) {
    all_m += layer.thickness_m;
    kgpm2 += layer.thickness_m * layer.density_kgpm3;
    friction_m += layer.thickness_m * std::tan(layer.friction_rad);
    tool_m += layer.thickness_m * std::tan(layer.tool_friction_rad);
    cohesion_pam += layer.thickness_m * layer.cohesion_pa;
  }
  in.depth_m = all_m;
  in.density_kgpm3 = kgpm2 / all_m;
  in.friction_rad = std::atan(friction_m / all_m);
  in.tool_friction_rad = std::atan(tool_m / all_m);
  in.cohesion_pa = cohesion_pam / all_m;
  return in;
}

CuttingInput Blade(double rake_deg) {
  CuttingInput in;
  in.width_m = 0.6;
  in.rake_rad = rake_deg * kDeg;
  in.flank_share = 1;
  return in;
}

CuttingForce ForceIn(const std::vector<CutLayer>& layers, const CuttingInput& blade) {
  return CutLayers(Mean(layers, blade), layers);
}

TEST(LayeredCut, InOneSoilItIsTheEarthmovingEquation) {
  const std::vector<CutLayer> one = {Soil(0.3, 35, 3000)};
  for (const double rake_deg : {30, 60, 90}) {
    const CuttingInput in = Mean(one, Blade(rake_deg));
    EXPECT_EQ(CutLayers(in, one).draft_n, Cut(in).draft_n);
    EXPECT_EQ(CutLayers(in, one).vertical_n, Cut(in).vertical_n);
  }
}

// A border between equal soils. Each part is cut under the weight of those above, with the flanks'
// shear of its own depth, and the parts add up to the whole. Each has its own best angle, which
// differs where cohesion and weight prefer different ones. Each has its own spiral, which takes up
// to 5 % less than one through all parts.
TEST(LayeredCut, PartsOfOneSoilAddUpToTheWhole) {
  for (const double cohesion_pa : {0.0, 3000.0}) {
    const std::vector<CutLayer> parts = {Soil(0.12, 35, cohesion_pa), Soil(0.10, 35, cohesion_pa),
                                         Soil(0.08, 35, cohesion_pa)};
    for (const double rake_deg : {30, 45, 60, 90}) {
      SCOPED_TRACE(testing::Message() << cohesion_pa << " Pa, " << rake_deg << " deg");
      const CuttingInput in = Mean(parts, Blade(rake_deg));
      const double of_whole = CutLayers(in, parts).draft_n / Cut(in).draft_n;
      EXPECT_NEAR(of_whole, 1, rake_deg < 90 ? 0.02 : 0.05);
    }
  }
}

// Rankine: a smooth upright plate meets sigma_v K_p + 2 c sqrt(K_p) in each layer.
TEST(LayeredCut, ASmoothUprightPlateMeetsRankinesPressureInEachLayer) {
  CuttingInput blade = Blade(90);
  blade.flank_share = 0;
  std::vector<CutLayer> layers = {Soil(0.2, 38, 0), Soil(0.1, 30, 6000)};
  for (CutLayer& layer : layers) layer.tool_friction_rad = 0;
  const double g_npm3 = 1600 * kStandardGravity_mps2;
  const double upper_kp = std::pow(std::tan(64 * kDeg), 2), lower_kp = 3;
  const double upper_n = upper_kp * g_npm3 * 0.2 * 0.2 / 2;
  const double lower_n =
      lower_kp * g_npm3 * (0.2 * 0.1 + 0.1 * 0.1 / 2) + 2 * 6000 * 0.1 * std::sqrt(lower_kp);
  EXPECT_NEAR(ForceIn(layers, blade).draft_n / (0.6 * (upper_n + lower_n)), 1, 1e-3);
}

// A crust on a soft seam, before an upright plate with friction delta against it. The crust moves
// as a block b long on the seam, H = (W - V) tan phi_s + c_s b + Rankine's wedge before it. V = H
// cot(90 deg + delta) is the plate's lift.
TEST(LayeredCut, ACrustSlidesOnTheSoftSeamBelowIt) {
  constexpr double kCrust_m = 0.30, kSeam_m = 1e-5;
  CuttingInput blade = Blade(90);
  blade.flank_share = 0;
  const std::vector<CutLayer> layers = {Soil(kCrust_m, 40, 2000), Soil(kSeam_m, 8, 500)};
  const double kp = std::pow(std::tan(65 * kDeg), 2);
  const double weight_npm = 1600 * kStandardGravity_mps2 * kCrust_m * kCrust_m;
  const double wedge_npm = 0.5 * weight_npm * kp + 2 * 2000 * kCrust_m * std::sqrt(kp);
  const double draft_npm = (wedge_npm + weight_npm * std::tan(8 * kDeg) + 500 * kCrust_m) /
                           (1 - std::tan(20 * kDeg) * std::tan(8 * kDeg));
  const CuttingForce force = ForceIn(layers, blade);
  EXPECT_NEAR(force.draft_n / (0.6 * draft_npm), 1, 2e-3);
  EXPECT_NEAR(force.vertical_n / force.draft_n, -std::tan(20 * kDeg), 2e-3);
  // Without the seam the plate's friction holds the crust down.
  EXPECT_LT(force.draft_n, 0.75 * ForceIn({layers[0]}, blade).draft_n);
}

TEST(LayeredCut, TheOrderOfLayersCounts) {
  // The weight above provides friction, so that the rough soil resists more below.
  const CutLayer smooth = Soil(0.15, 10, 3000), rough = Soil(0.15, 40, 0);
  EXPECT_LT(ForceIn({rough, smooth}, Blade(60)).draft_n,
            0.9 * ForceIn({smooth, rough}, Blade(60)).draft_n);
}

TEST(LayeredCut, AHeapThatFallsOffLeavesTheFirmGroundUnderItLevel) {
  std::vector<CutLayer> layers = {Soil(0.1, 40, 0), Soil(0.2, 40, 3000)};
  layers[0].is_loose = true;
  CuttingInput blade = Blade(60);
  blade.slope_rad = blade.firm_slope_rad = -20 * kDeg;
  const double on_falling_n = ForceIn(layers, blade).draft_n;
  blade.firm_slope_rad = 0;
  EXPECT_GT(ForceIn(layers, blade).draft_n, 1.02 * on_falling_n);
}

TEST(LayeredCut, IsNeverAboveTheMeansAndGrowsWithEachStrength) {
  const Stream random(11, "test/layers");
  for (std::uint64_t k = 0; k < 2000; ++k) {
    SCOPED_TRACE(k);
    const auto in = [&](int n, double low, double high) {
      return low + (high - low) * random.Uniform(k, n);
    };
    std::vector<CutLayer> layers;
    const int count = 2 + static_cast<int>(in(0, 0, 3));
    for (int n = 0; n < count; ++n) {
      layers.push_back(Soil(in(10 * n + 1, 0.01, 0.3), in(10 * n + 2, 5, 42),
                            std::max(0.0, in(10 * n + 3, -1e4, 2e4)), in(10 * n + 4, 1300, 2100)));
    }
    CuttingInput blade = Blade(in(90, 15, 110));
    blade.slope_rad = in(91, -25, 25) * kDeg;
    blade.surcharge_pa = std::max(0.0, in(92, -5e3, 5e3));
    const CuttingForce force = ForceIn(layers, blade);
    EXPECT_TRUE(std::isfinite(force.draft_n) && std::isfinite(force.vertical_n));
    EXPECT_GE(force.draft_n, 0);
    EXPECT_LE(force.draft_n, Cut(Mean(layers, blade)).draft_n);
    layers[0].cohesion_pa += 5000;
    EXPECT_GE(ForceIn(layers, blade).draft_n, 0.999 * force.draft_n);
  }
}

}  // namespace
}  // namespace tera
