#include "render/gl/passes/rain_pass.h"

#include <gtest/gtest.h>

#include "core/units.h"
#include "render/air/rain.h"
#include "render/gl/rasterizer.h"
#include "render/gl/rasterizer_stage.h"

namespace tera {
namespace {

/// Mean luminance of a black wall in rain, over several moments.
double MeanOfBlackWall(double rain_mmph, double exposure_s) {
  Stage stage;
  stage.AddBox(MakePose(Vec3(0, 20, 2)), Vec3(40, 0.1, 40), SemanticClass::kStructure,
               Vec3::Zero());
  stage.model.environment.fog_visibility_m = 1e9;
  stage.model.environment.weather.rain_mmph = rain_mmph;
  stage.model.environment.cloud_cover = 1;
  stage.state.exposure_s = exposure_s;
  Rasterizer rasterizer(stage.model, EglOptions{});
  double sum = 0;
  constexpr int kMoments = 6;
  for (int k = 0; k < kMoments; ++k) {
    stage.state.t_ns = k * 370'000'000;
    LuminancePicture luminance{.white_cdpm2 = 4000, .cdpm2 = {}};
    rasterizer.RenderLuminance(Pinhole(), LookAt(Vec3(0, 0, 2), Vec3(0, 20, 2)), stage.state,
                               &luminance);
    for (const float l : luminance.cdpm2.data) {
      sum += l / static_cast<double>(luminance.cdpm2.data.size() * kMoments);
    }
  }
  return sum;
}

/// Cross-section, for each m^3, of drops between two diameters.
double Area_1pm(double rain_mmph, double least_m, double most_m) {
  const Rain rain(rain_mmph);
  constexpr double kStep_m = 1e-6;
  double sum = 0;
  for (double d = least_m; d < most_m; d += kStep_m) {
    sum += kPi / 4 * d * d * (rain.CountAbove_1pm3(d) - rain.CountAbove_1pm3(d + kStep_m));
  }
  return sum;
}

/// Share of the picture covered by drops: for each solid angle, their cross-section from 0.15 m to
/// the end of their boxes, 0.8, 2 and 4 m.
double Covered(double rain_mmph) {
  return Area_1pm(rain_mmph, 0.5e-3, 1e-3) * 0.65 + Area_1pm(rain_mmph, 1e-3, 2e-3) * 1.85 +
         Area_1pm(rain_mmph, 2e-3, 6e-3) * 3.85;
}

TEST(RainPass, CoversAsMuchOfThePictureAsItsDropsDo) {
  // The wall itself contributes slightly: the specular reflection of a matt black surface.
  const double wall = MeanOfBlackWall(0, 0.001);
  const double light = MeanOfBlackWall(8, 0.001) - wall, heavy = MeanOfBlackWall(60, 0.001) - wall;
  ASSERT_GT(light, 0);
  EXPECT_NEAR(heavy / light, Covered(60) / Covered(8), 0.3 * Covered(60) / Covered(8));
}

TEST(RainPass, AStreakTakesAsMuchLightWhateverTheExposure) {
  const double wall = MeanOfBlackWall(0, 0.001);
  const double brief = MeanOfBlackWall(60, 0.0005) - wall, slow = MeanOfBlackWall(60, 0.004) - wall;
  EXPECT_NEAR(slow / brief, 1, 0.25);
}

}  // namespace
}  // namespace tera
