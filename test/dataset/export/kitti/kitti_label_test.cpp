#include "dataset/export/kitti/kitti_label.h"

#include <gtest/gtest.h>

#include "core/units.h"

namespace tera {
namespace {

/// 40 x 30 pixels, 90 deg wide: x / z from -1 to 1.
CameraLens Lens() {
  CameraLens lens;
  lens.width_px = 40;
  lens.height_px = 30;
  lens.fx_px = lens.fy_px = 20;
  lens.cx_px = 19.5;
  lens.cy_px = 14.5;
  return lens;
}

/// Upright, 2 m long, 1 m wide, 1.8 m high, its middle at (1, 0.5, 8); `forward_C` without y.
ObjectBox Upright(const Vec3& forward_C) {
  ObjectBox box;
  box.instance = 7;
  box.label = SemanticClass::kPerson;
  box.name = "walker";
  box.visibility = 0.95;
  const Vec3 up_C = -Vec3::UnitY();
  Mat3 R_CO;
  R_CO << forward_C, up_C.cross(forward_C), up_C;
  box.X_CO = MakePose(Vec3(1, 0.5, 8), R_CO);
  box.size_O_m = Vec3(2, 1, 1.8);
  return box;
}

std::map<std::uint16_t, ObjectMask> MaskOf(std::uint16_t instance) {
  std::map<std::uint16_t, ObjectMask> masks;
  masks[instance].bounds = {20, 12, 23, 18};
  return masks;
}

KittiLabel LabelOf(const ObjectBox& box) {
  return KittiLabels({box}, MaskOf(box.instance), Lens(), "digger").at(0);
}

// By the development kit: ry 0 is along the camera's x; a car ahead that drives away has -pi/2.
TEST(KittiLabel, RotationIsAboutTheCamerasDownwardAxis) {
  EXPECT_NEAR(LabelOf(Upright(Vec3::UnitX())).rotation_y_rad, 0, 1e-12);
  EXPECT_NEAR(LabelOf(Upright(Vec3::UnitZ())).rotation_y_rad, -90 * kDeg, 1e-12);
  EXPECT_NEAR(LabelOf(Upright(-Vec3::UnitZ())).rotation_y_rad, 90 * kDeg, 1e-12);
}

TEST(KittiLabel, ALineHasTheFifteenFields) {
  // The bearing of (1, 8) is atan(1 / 8) = 0.124355.
  EXPECT_EQ(ObjectLine(LabelOf(Upright(Vec3::UnitX()))),
            "Pedestrian 0.0000 0 -0.124355 20.00 12.00 23.00 18.00 1.8000 1.0000 2.0000 1.0000 "
            "1.4000 8.0000 0.000000\n");
}

TEST(KittiLabel, ATrackHasItsFrameAndItsNumberFirst) {
  EXPECT_EQ(TrackLine(3, LabelOf(Upright(Vec3::UnitX()))).substr(0, 28),
            "3 7 Pedestrian 0 0 -0.124355");
}

TEST(KittiLabel, WhatLeavesThePictureIsTruncatedByItsShare) {
  ObjectBox box = Upright(Vec3::UnitX());
  // Thin along z and 2 m wide, its middle on the picture's right edge at x / z = 1: half is in.
  box.size_O_m.y() = 0.01;
  box.X_CO.translation() = Vec3(8, 0, 8);
  const KittiLabel label = LabelOf(box);
  EXPECT_NEAR(label.truncated, 0.5, 1.0 / 16);
  EXPECT_EQ(TrackLine(0, label).substr(0, 16), "0 7 Pedestrian 1");
  box.X_CO.translation() = Vec3(0, 0, -8);
  EXPECT_EQ(LabelOf(box).truncated, 1);
}

TEST(KittiLabel, HiddenSharesAreLevels) {
  ObjectBox box = Upright(Vec3::UnitX());
  for (const auto& [visibility, level] :
       {std::pair(0.9, '0'), {0.89, '1'}, {0.5, '1'}, {0.49, '2'}}) {
    box.visibility = visibility;
    EXPECT_EQ(ObjectLine(LabelOf(box))[18], level) << visibility;
  }
}

TEST(KittiLabel, TheOwnMachineIsARegionAndPartsAreLeftOut) {
  ObjectBox own = Upright(Vec3::UnitX());
  own.name = "digger";
  EXPECT_EQ(ObjectLine(LabelOf(own)),
            "DontCare -1 -1 -10 20.00 12.00 23.00 18.00 -1 -1 -1 -1000 -1000 -1000 -10\n");
  own.name = "digger2";
  EXPECT_FALSE(LabelOf(own).is_region);
  own.parent = 9;
  EXPECT_TRUE(KittiLabels({own}, MaskOf(own.instance), Lens(), "digger").empty());
  EXPECT_TRUE(KittiLabels({Upright(Vec3::UnitX())}, {}, Lens(), "digger").empty());
}

}  // namespace
}  // namespace tera
