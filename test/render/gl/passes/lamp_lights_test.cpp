#include <gtest/gtest.h>

#include <cstdlib>

#include "core/units.h"
#include "render/gl/rasterizer_stage.h"

namespace tera {
namespace {

const Vec3 kBelow(0, 0, 0);  ///< on the ground, right below the lamp

/// Brightness added by the lamp below it, of 255, with or without a box in its beam.
int Brighter(bool has_box) {
  int red[2];
  for (const bool is_on : {false, true}) {
    Stage stage;
    stage.SetTerrain(Ground(80, 0.1, Level));
    // Its top lies before the near plane of the lamp's picture, 0.25 m, its bottom beyond it.
    if (has_box) {
      stage.AddBox(MakePose(Vec3(0, 0, 2.55)), Vec3(0.5, 0.5, 0.3), SemanticClass::kBoom);
    }
    stage.model.lamps.push_back({.X_BL = MakePose(Vec3(0, 0, 3), 0, 90 * kDeg, 0),
                                 .flux_lm = is_on ? 5e6 : 1e-3,
                                 .half_angle_rad = 30 * kDeg});
    const CameraFrame frame = stage.Shoot(Pinhole(), LookAt(Vec3(3, -1, 0.9), kBelow));
    const std::size_t pixel = 118 * 320 + 163;  // the principal point
    red[is_on] = frame.rgb.data[3 * pixel];
  }
  return red[1] - red[0];
}

TEST(LampLights, ShineOnWhatIsBelow) { EXPECT_GT(Brighter(false), 20); }

TEST(LampLights, DoNotShineThroughWhatTheirNearPlaneCuts) {
  EXPECT_LE(std::abs(Brighter(true)), 1);
}

}  // namespace
}  // namespace tera
