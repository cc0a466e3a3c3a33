#include "render/gl/passes/worn_surfaces.h"

#include <gtest/gtest.h>

#include <memory>

#include "render/gl/rasterizer_stage.h"

namespace tera {
namespace {

const Vec3 kPaint(0.02, 0.05, 0.60), kSoil(0.32, 0.22, 0.12);

/// A blue box of 2 m, its foot on the ground's level, seen from one side and above.
Stage BlueBox(const std::optional<NodeWear>& wear) {
  Stage stage;
  stage.AddBox(MakePose(Vec3(0, 0, 1)), Vec3(1, 1, 1), SemanticClass::kTruck, kPaint);
  if (wear) stage.model.nodes[0].wear = std::make_shared<const NodeWear>(*wear);
  return stage;
}

CameraFrame Shoot(const Stage& stage) {
  return stage.Shoot(Pinhole(), LookAt(Vec3(1.2, -4.2, 3.2), Vec3(0, 0, 0.9)));
}

NodeWear OnGround(const Wear& wear) {
  return {.wear = wear,
          .soil_albedo = kSoil,
          .from_soil_normal_B = Vec3::UnitZ(),
          .from_soil_offset_m = 1};  // the box's frame is in its middle
}

/// Mean share of blue in the visible part of the box within a range of world heights.
double Blue(const CameraFrame& frame, double low_m, double high_m) {
  const CameraIntrinsics camera = Pinhole();
  const Pose X_WC = LookAt(Vec3(1.2, -4.2, 3.2), Vec3(0, 0, 0.9));
  double sum = 0;
  int count = 0;
  for (int y = 0; y < camera.height_px; ++y) {
    for (int x = 0; x < camera.width_px; ++x) {
      if (frame.instance.at(x, y) != 1) continue;
      const double depth_m = frame.depth_m.at(x, y);
      const Vec3 p_C_m =
          depth_m * Vec3((x - camera.cx_px) / camera.fx_px, (y - camera.cy_px) / camera.fy_px, 1);
      const Vec3 p_W_m = X_WC * p_C_m;
      if (p_W_m.z() < low_m || p_W_m.z() > high_m) continue;
      const double r = frame.rgb.at(x, y, 0), g = frame.rgb.at(x, y, 1), b = frame.rgb.at(x, y, 2);
      sum += b / (r + g + b + 1);
      ++count;
    }
  }
  EXPECT_GT(count, 200);
  return sum / count;
}

TEST(WornSurfaces, DustLiesOnWhatFacesUpwardMoreThanOnUprightFaces) {
  const CameraFrame fresh = Shoot(BlueBox({})), dusty = Shoot(BlueBox(OnGround({.dust = 0.8})));
  const double top = Blue(fresh, 1.98, 2.1) - Blue(dusty, 1.98, 2.1);
  const double side = Blue(fresh, 1.2, 1.9) - Blue(dusty, 1.2, 1.9);
  EXPECT_GT(top, 0.15);
  EXPECT_GT(top, 1.3 * side);
}

TEST(WornSurfaces, MudIsWhereTheSoilIsNear) {
  const CameraFrame fresh = Shoot(BlueBox({})), muddy = Shoot(BlueBox(OnGround({.mud = 0.4})));
  const double low = Blue(fresh, 0.02, 0.35) - Blue(muddy, 0.02, 0.35);
  const double high = Blue(fresh, 1.4, 1.95) - Blue(muddy, 1.4, 1.95);
  EXPECT_GT(low, 0.15);
  EXPECT_LT(high, 0.2 * low);
}

TEST(WornSurfaces, OnlyColourChanges) {
  const NodeWear worst = OnGround({.dust = 1, .mud = 1, .scratches = 1, .rust = 1});
  const CameraFrame fresh = Shoot(BlueBox({})), worn = Shoot(BlueBox(worst));
  EXPECT_EQ(worn.depth_m.data, fresh.depth_m.data);
  EXPECT_EQ(worn.instance.data, fresh.instance.data);
  EXPECT_EQ(worn.semantic.data, fresh.semantic.data);
  EXPECT_NE(worn.rgb.data, fresh.rgb.data);
}

TEST(WornSurfaces, NothingOfItLooksLikeNew) {
  EXPECT_EQ(Shoot(BlueBox(OnGround({}))).rgb.data, Shoot(BlueBox({})).rgb.data);
}

TEST(WornSurfaces, ACuttingEdgeIsRubbedBare) {
  NodeWear worn = OnGround({.scratches = 0.5});
  worn.from_soil_normal_B = Vec3::Zero();
  worn.from_soil_offset_m = 5;  // no soil near: the edge alone counts
  const CameraFrame without = Shoot(BlueBox(worn));
  worn.edge_B_m = Vec2(1, 1);  // the upper corner towards +x, along y
  const CameraFrame with = Shoot(BlueBox(worn));
  EXPECT_LT(Blue(with, 1.95, 2.1), Blue(without, 1.95, 2.1) - 0.01);
  EXPECT_NEAR(Blue(with, 0.1, 1.0), Blue(without, 0.1, 1.0), 0.01);
}

}  // namespace
}  // namespace tera
