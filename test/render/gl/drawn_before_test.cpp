#include <gtest/gtest.h>

#include "core/units.h"
#include "rasterizer_stage.h"
#include "render/gl/rasterizer.h"

/// A rasterizer caches ground, shadows, lamps' light and silhouettes. No picture may depend on the
/// cache.

namespace tera {
namespace {

/// Boxes on waves under sun and a lamp: a machine of two parts, and a rock that casts a shadow.
Stage Site() {
  Stage stage;
  stage.SetTerrain(Ground(120, 0.1, Waves));
  stage.AddBox(MakePose(kTarget), Vec3(0.4, 0.4, 0.4), SemanticClass::kUpperStructure);
  stage.AddBox(MakePose(kTarget + Vec3(0.9, 0, 0.3)), Vec3(0.3, 0.2, 0.2), SemanticClass::kBoom);
  stage.AddBox(MakePose(kTarget + Vec3(-1.2, 0.5, 0.2)), Vec3(0.3, 0.3, 0.5), SemanticClass::kRock);
  const auto whole = static_cast<std::uint16_t>(stage.model.instances.size());
  stage.model.instances[1].parent = stage.model.instances[2].parent = whole;
  stage.model.instances.push_back(
      {.name = "machine", .label = SemanticClass::kVehicle, .body = 0, .is_whole = true});
  stage.model.lamps.push_back({.X_BL = MakePose(Vec3(3, -2, 3), 0, 40 * kDeg, 150 * kDeg),
                               .flux_lm = 5e6,
                               .half_angle_rad = 40 * kDeg});
  return stage;
}

void Dig(TerrainSurface* terrain, int from, int to, float by_m) {
  for (int j = from; j < to; ++j) {
    for (int i = from; i < to; ++i) {
      TerrainSurface::Vertex vertex = terrain->at(i, j);
      vertex.height_m -= by_m;
      vertex.cover.looseness = 255;
      terrain->Set(i, j, vertex);
    }
  }
}

class DrawnBefore : public testing::Test {
 protected:
  /// Compares a picture by the used rasterizer with one by a new rasterizer.
  void ExpectAsNew(const CameraIntrinsics& camera, const Vec3& eye_W_m) {
    const Pose X_WC = LookAt(eye_W_m, kTarget);
    const CameraFrame used = rasterizer_.Render(camera, X_WC, stage_.state);
    const CameraFrame fresh = stage_.Shoot(camera, X_WC);
    EXPECT_EQ(used.rgb.data, fresh.rgb.data);
    EXPECT_EQ(used.depth_m.data, fresh.depth_m.data);
    EXPECT_EQ(used.instance.data, fresh.instance.data);
    ASSERT_EQ(used.boxes.size(), fresh.boxes.size());
    for (std::size_t k = 0; k < used.boxes.size(); ++k) {
      EXPECT_EQ(used.boxes[k].visibility, fresh.boxes[k].visibility) << used.boxes[k].name;
    }
  }
  Pose& PoseOf(int box) { return stage_.state.X_WB[static_cast<std::size_t>(box)]; }

  Stage stage_ = Site();
  Rasterizer rasterizer_{stage_.model, EglOptions{}};
};

TEST_F(DrawnBefore, IsGoneWhereBodiesMove) {
  ExpectAsNew(Pinhole(), kEye);
  PoseOf(1).translation().z() += 0.4;  // the boom, between the rock and the sun
  ExpectAsNew(Pinhole(), kEye);
  PoseOf(1).translation().x() -= 1.5;
  ExpectAsNew(Pinhole(), kEye);
  PoseOf(2).translation().y() -= 0.7;  // the rock, at rest until now
  ExpectAsNew(Pinhole(), kEye);
  PoseOf(2) = Site().state.X_WB[2];
  ExpectAsNew(Pinhole(), kEye);
}

TEST_F(DrawnBefore, IsGoneWhereTheCameraMoves) {
  for (const Vec3& eye_W_m : {kEye, Vec3(kEye + Vec3(9, 0, 2)), kEye}) {
    ExpectAsNew(Pinhole(), eye_W_m);
    ExpectAsNew(WideLens(), eye_W_m);
    PoseOf(0).translation().x() += 0.2;
  }
}

TEST_F(DrawnBefore, IsGoneWhereGroundIsDug) {
  ExpectAsNew(Pinhole(), kEye);
  Dig(&stage_.terrain, 55, 63, 0.15f);
  ExpectAsNew(Pinhole(), kEye);
  Dig(&stage_.terrain, 48, 52, -0.3f);  // across the border of four tiles
  ExpectAsNew(Pinhole(), kEye);
  TerrainSurface::Vertex wet = stage_.terrain.at(60, 58);
  wet.cover.moisture = 255;  // its looks alone
  stage_.terrain.Set(60, 58, wet);
  ExpectAsNew(Pinhole(), kEye);
}

}  // namespace
}  // namespace tera
