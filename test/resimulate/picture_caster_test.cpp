#include "resimulate/picture_caster.h"

#include <gtest/gtest.h>

#include <memory>

#include "dataset/format/sample_recording.h"
#include "resimulate/recorded_cart.h"
#include "sensors/camera/camera.h"

namespace tera {
namespace {

CameraIntrinsics Lens() {
  CameraIntrinsics lens;
  lens.width_px = 160;
  lens.height_px = 120;
  lens.fx_px = 110;
  lens.fy_px = 115;
  lens.cx_px = 77;
  lens.cy_px = 61.5;
  return lens;
}

TEST(Reduced, APixelOfTheSmallPictureSeesWhereTheMiddleOfWhatItCoversDoes) {
  constexpr int kTimes = 4;
  const CameraIntrinsics small = Reduced(Lens(), kTimes);
  EXPECT_EQ(small.width_px, 40);
  EXPECT_EQ(small.height_px, 30);
  // It covers the pixels 4 k to 4 k + 3 of the large one, whose middle is 4 k + 1.5.
  for (const auto& [x, y] : {std::pair{0, 0}, std::pair{17, 5}, std::pair{39, 29}}) {
    const auto of_small = small.RayOf(Vec2(x, y));
    const auto of_large = Lens().RayOf(Vec2(kTimes * x + 1.5, kTimes * y + 1.5));
    ASSERT_TRUE(of_small && of_large);
    EXPECT_LT((*of_small - *of_large).norm(), 1e-9);
  }
}

TEST(ReducedGrey, IsTheMeanBrightnessOfWhatAPixelCovers) {
  Image<std::uint8_t> rgb(4, 2, 3);
  for (int y = 0; y < 2; ++y) {  // two white pixels of four on the left, all green on the right
    for (int x = 0; x < 4; ++x) {
      rgb.at(x, y, 1) = x >= 2 || x == y ? 255 : 0;
      if (x < 2) rgb.at(x, y, 0) = rgb.at(x, y, 2) = rgb.at(x, y, 1);
    }
  }
  const Image<float> grey = ReducedGrey(rgb, 2);
  ASSERT_EQ(grey.width_px, 2);
  ASSERT_EQ(grey.height_px, 1);
  EXPECT_NEAR(grey.at(0, 0), 0.5, 1e-6);
  EXPECT_NEAR(grey.at(1, 0), 0.587, 1e-6);  // Rec. 601
}

/// Drives in a curve on level ground.
Pose Driven(double t_s) {
  return MakePose(Vec3(1 + 2 * t_s, -1, 0.2), RotationFromRpy(0, 0, 0.3 + 0.1 * t_s));
}
double Turned(double t_s) { return 0.2 * t_s; }

TEST(PictureCaster, DepthIsAlongTheOpticalAxisToTheGroundFromWhereTheCameraWas) {
  const ScratchDirectory scratch;
  const Scenario scenario = CartScenario(scratch.path());
  const RecordedCart cart{.pose_t_ns = EvenTimes(0, 3, 0.01),
                          .turn_t_ns = EvenTimes(0, 3, 0.01),
                          .X_WB = Driven,
                          .turn_rad = Turned};
  std::vector<RecordedMotion> machines;
  machines.emplace_back(scenario.machines[0].placement, cart.machine,
                        WriteCart(scratch.path() / "r", cart));
  const SceneAssembly assembly(scenario);
  RecordedStage stage(scenario, machines, 0);
  PictureCaster caster(scenario, assembly, stage, machines);
  SensorDescription sensor;
  sensor.link = "mast";
  sensor.X_BS = MakePose(Vec3(0.2, 0.1, 1), RotationFromRpy(0.05, 0.5, -0.2));  // looking down
  CameraModel camera;
  camera.intrinsics = Lens();
  sensor.model = camera;

  constexpr int kTimes = 2;
  const SensorCalibration late{.X_BT = sensor.X_BS, .clock_offset_s = 0.5};
  const auto picture = caster.Render(
      0, sensor, {FromSeconds(1.5), 0, stage.AdvanceTo(FromSeconds(1.5))}, late, kTimes);
  ASSERT_TRUE(picture);
  const Pose X_BaseMast = MakePose(Vec3(0, 0, kMastHeight_m), RotationFromRpy(0, 0, Turned(1)));
  const Pose X_WC = Driven(1) * X_BaseMast * sensor.X_BS * OpticalInSensor();
  const CameraIntrinsics lens = Reduced(Lens(), kTimes);
  for (const auto& [x, y] : {std::pair{40, 30}, std::pair{5, 50}, std::pair{70, 35}}) {
    const auto ray_C = lens.RayOf(Vec2(x, y));
    ASSERT_TRUE(ray_C);
    const double depth_m = -X_WC.translation().z() / (X_WC.linear() * *ray_C).z();
    EXPECT_NEAR(picture->depth_m.at(x, y), depth_m, 0.01) << x << ' ' << y;
    EXPECT_EQ(picture->surface.at(x, y), static_cast<std::uint8_t>(Surface::kGround));
  }
  EXPECT_FALSE(
      caster.Render(0, sensor, {FromSeconds(9), 0, stage.AdvanceTo(FromSeconds(9))}, late, kTimes));
}

}  // namespace
}  // namespace tera
