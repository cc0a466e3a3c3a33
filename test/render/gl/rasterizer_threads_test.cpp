#include <gtest/gtest.h>

#include "rasterizer_stage.h"
#include "render/gl/rasterizer.h"

/// Pictures do not depend on data shared between threads: the ground's texels, labels, boxes.

namespace tera {
namespace {

Stage RasterizerThreadsSite() {
  Stage stage;
  stage.SetTerrain(Ground(120, 0.1, Waves));
  stage.AddBox(MakePose(kTarget), Vec3(0.4, 0.4, 0.4), SemanticClass::kUpperStructure);
  stage.AddBox(MakePose(kTarget + Vec3(0.9, 0, 0.3)), Vec3(0.3, 0.2, 0.2), SemanticClass::kBoom);
  stage.AddBox(MakePose(kTarget + Vec3(-1, 1, 0.2)), Vec3(0.3, 0.3, 0.5), SemanticClass::kRock);
  const auto whole = static_cast<std::uint16_t>(stage.model.instances.size());
  stage.model.instances[1].parent = stage.model.instances[2].parent = whole;
  stage.model.instances.push_back(
      {.name = "machine", .label = SemanticClass::kVehicle, .body = 0, .is_whole = true});
  return stage;
}

class Threads : public testing::TestWithParam<int> {
 protected:
  Threads() { labels_.set(kNormalChannel); }
  void Dig() {
    for (int j = 50; j < 70; ++j) {
      for (int i = 40; i < 66; ++i) {  // across borders of tiles
        TerrainSurface::Vertex vertex = stage_.terrain.at(i, j);
        vertex.height_m -= 0.1f;
        vertex.cover.looseness = 255;
        stage_.terrain.Set(i, j, vertex);
      }
    }
  }
  void ExpectSame(const CameraIntrinsics& camera) {
    const Pose X_WC = LookAt(kEye, kTarget);
    const CameraFrame one = alone_.Render(camera, X_WC, stage_.state, labels_);
    const CameraFrame many = shared_.Render(camera, X_WC, stage_.state, labels_);
    EXPECT_EQ(one.rgb.data, many.rgb.data);
    EXPECT_EQ(one.depth_m.data, many.depth_m.data);
    EXPECT_EQ(one.semantic.data, many.semantic.data);
    EXPECT_EQ(one.instance.data, many.instance.data);
    EXPECT_EQ(one.normal.data, many.normal.data);
    ASSERT_EQ(one.boxes.size(), many.boxes.size());
    ASSERT_EQ(one.boxes.size(), 4u);
    for (std::size_t k = 0; k < one.boxes.size(); ++k) {
      const ObjectBox &a = one.boxes[k], &b = many.boxes[k];
      EXPECT_EQ(a.name, b.name);
      EXPECT_EQ(a.x_min_px, b.x_min_px) << a.name;
      EXPECT_EQ(a.y_max_px, b.y_max_px) << a.name;
      EXPECT_EQ(a.visible_px, b.visible_px) << a.name;
      EXPECT_EQ(a.visibility, b.visibility) << a.name;
      EXPECT_EQ(a.amodal_min_px, b.amodal_min_px) << a.name;
      EXPECT_EQ(a.amodal_max_px, b.amodal_max_px) << a.name;
    }
  }

  Stage stage_ = RasterizerThreadsSite();
  LabelSet labels_;
  Rasterizer alone_{stage_.model, EglOptions{}}, shared_{stage_.model, EglOptions{}, GetParam()};
};

TEST_P(Threads, ChangeNoPictureWhateverTheirNumber) {
  for (const CameraIntrinsics& camera : {Pinhole(), WideLens()}) ExpectSame(camera);
  Dig();
  ExpectSame(Pinhole());
}

INSTANTIATE_TEST_SUITE_P(Numbers, Threads, testing::Values(2, 5));

}  // namespace
}  // namespace tera
