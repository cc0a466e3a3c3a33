#include <gtest/gtest.h>

#include <array>

#include "rasterizer_stage.h"
#include "render/gl/rasterizer.h"

namespace tera {
namespace {

// Instance 300 = 44 + 1 * 256 of a scene, on level ground under the sky.
TEST(PanopticPicture, HasTheClassAndTheInstanceInTwoBytes) {
  constexpr std::uint16_t kMany = 300;
  Stage stage;
  stage.SetTerrain(Ground(60, 0.5, Level));
  stage.model.instances.resize(kMany, stage.model.instances.front());
  const std::uint16_t instance =
      stage.AddBox(MakePose({0, 0, 0.5}), {1, 1, 0.5}, SemanticClass::kTruck);
  ASSERT_EQ(instance, kMany);
  LabelSet labels = UsualLabels();
  const std::size_t panoptic = 13;
  ASSERT_EQ(kLabelChannels[panoptic].name, "panoptic");
  labels.set(panoptic);
  const CameraIntrinsics camera = Pinhole();
  const CameraFrame frame =
      Rasterizer(stage.model, EglOptions{})
          .Render(camera, LookAt({8, 0, 2}, {0, 0, 1.2}), stage.state, labels);
  ASSERT_EQ(frame.panoptic.channels, 3);
  const auto value_at = [&](int x, int y) {
    return std::array<int, 3>{frame.panoptic.at(x, y, 0), frame.panoptic.at(x, y, 1),
                              frame.panoptic.at(x, y, 2)};
  };
  const int box_y = static_cast<int>(
      camera.Project(LookAt({8, 0, 2}, {0, 0, 1.2}).inverse() * Vec3(1, 0, 0.5)).y());
  EXPECT_EQ(value_at(163, box_y), (std::array<int, 3>{10, 44, 1}));
  EXPECT_EQ(value_at(20, 235), (std::array<int, 3>{1, 0, 0})) << "ground";
  EXPECT_EQ(value_at(20, 3), (std::array<int, 3>{0, 0, 0})) << "sky";
  for (int y = 0; y < camera.height_px; ++y) {
    for (int x = 0; x < camera.width_px; ++x) {
      const auto value = value_at(x, y);
      ASSERT_EQ(value[0], frame.semantic.at(x, y));
      ASSERT_EQ(value[1] + 256 * value[2], frame.instance.at(x, y));
    }
  }
}

}  // namespace
}  // namespace tera
