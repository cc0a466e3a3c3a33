#include "render/gl/amodal_boxes.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "rasterizer_stage.h"
#include "render/gl/rasterizer.h"

/// Boxes of occluded or cut objects, against geometry.

namespace tera {
namespace {

/// Looks along +y of W from 1 m above absent ground; x of C is x of W.
const Pose kAhead = LookAt({0, 0, 1}, {0, 1, 1});

ObjectBox BoxOf(const CameraFrame& frame, std::uint16_t instance) {
  const auto found = std::find_if(frame.boxes.begin(), frame.boxes.end(),
                                  [&](const ObjectBox& box) { return box.instance == instance; });
  EXPECT_NE(found, frame.boxes.end()) << instance;
  return found == frame.boxes.end() ? ObjectBox{} : *found;
}

TEST(AmodalBox, OfAHiddenObjectIsWhole) {
  Stage stage;
  const Pose X_WB = MakePose(Vec3(0.2, 5, 1.1));
  const auto behind = stage.AddBox(X_WB, {0.6, 0.1, 0.4}, SemanticClass::kRock);
  stage.AddBox(MakePose(Vec3(0.5, 3, 1)), {0.25, 0.1, 0.8}, SemanticClass::kBarrier);
  const CameraIntrinsics lens = Pinhole();
  const ObjectBox box = BoxOf(stage.Shoot(lens, kAhead), behind);
  EXPECT_LT(box.visibility, 0.9);
  // Its face is 4.9 m away: the nearer one bounds it on every side.
  EXPECT_NEAR(box.amodal_min_px.x(), 163.2 + 260 * (0.2 - 0.6) / 4.9, 1e-3);
  EXPECT_NEAR(box.amodal_max_px.x(), 163.2 + 260 * (0.2 + 0.6) / 4.9, 1e-3);
  EXPECT_NEAR(box.amodal_min_px.y(), 117.7 - 255 * (0.1 + 0.4) / 4.9, 1e-3);
  EXPECT_NEAR(box.amodal_max_px.y(), 117.7 - 255 * (0.1 - 0.4) / 4.9, 1e-3);
  EXPECT_EQ(box.truncation, 0);
}

TEST(AmodalBox, GoesOnBeyondThePicture) {
  Stage stage;
  const auto wide = stage.AddBox(MakePose(Vec3(2, 5, 1)), {1.5, 0.05, 0.3}, SemanticClass::kRock);
  const ObjectBox box = BoxOf(stage.Shoot(Pinhole(), kAhead), wide);
  // The far face bounds it on the left, the near one on the right.
  const double left = 163.2 + 260 * 0.5 / 5.05, right = 163.2 + 260 * 3.5 / 4.95;
  EXPECT_NEAR(box.amodal_min_px.x(), left, 1e-3);
  EXPECT_NEAR(box.amodal_max_px.x(), right, 1e-3);
  EXPECT_NEAR(box.truncation, (right - 319.5) / (right - left), 2e-3);
}

TEST(AmodalBox, IsCutWhereTheObjectPassesTheEye) {
  Stage stage;
  CameraIntrinsics lens = Pinhole();
  lens.near_m = 0.5;
  // A beam along the line of sight, from 5 m behind the eye to 5 m before it, 1 m to the right.
  const auto beam = stage.AddBox(MakePose(Vec3(1, 0, 1)), {0.1, 5, 0.1}, SemanticClass::kRock);
  const ObjectBox box = BoxOf(stage.Shoot(lens, kAhead), beam);
  EXPECT_NEAR(box.amodal_min_px.x(), 163.2 + 260 * 0.9 / 5, 1e-3);
  EXPECT_NEAR(box.amodal_max_px.x(), 163.2 + 260 * 1.1 / 0.5, 1e-3);
  EXPECT_NEAR(box.amodal_max_px.y(), 117.7 + 255 * 0.1 / 0.5, 1e-3);
}

TEST(AmodalBox, HoldsTheVisibleOneBehindALens) {
  for (const CameraIntrinsics& lens : {WideLens(), RationalLens(), Fisheye()}) {
    Stage stage;
    const auto object = stage.AddBox(MakePose(Vec3(-0.7, 2.5, 0.6), 0.3, 0.2, 0.5), {0.5, 0.4, 0.3},
                                     SemanticClass::kRock);
    const ObjectBox box = BoxOf(stage.Shoot(lens, kAhead), object);
    // Corners bound a convex body except where the lens bends its edges, here by less than half a
    // pixel. The tip of a corner may cover no pixel's middle.
    EXPECT_LE(box.amodal_min_px.x(), box.x_min_px + 0.5);
    EXPECT_GE(box.amodal_max_px.x(), box.x_max_px - 0.5);
    EXPECT_LE(box.amodal_min_px.y(), box.y_min_px + 0.5);
    EXPECT_GE(box.amodal_max_px.y(), box.y_max_px - 0.5);
    EXPECT_GE(box.amodal_min_px.x(), box.x_min_px - 2);
    EXPECT_LE(box.amodal_max_px.x(), box.x_max_px + 2);
    EXPECT_GE(box.amodal_min_px.y(), box.y_min_px - 2);
    EXPECT_LE(box.amodal_max_px.y(), box.y_max_px + 2);
  }
}

TEST(Keypoints, AreSeenHiddenOrBeyondThePicture) {
  Stage stage;
  const Pose X_WB = MakePose(Vec3(0, 5, 1));
  const auto object = stage.AddBox(X_WB, {1, 0.2, 0.5}, SemanticClass::kPerson);
  stage.AddBox(MakePose(Vec3(0.4, 3, 1)), {0.2, 0.1, 0.5}, SemanticClass::kBarrier);
  const auto add = [&](const char* name, const Vec3& p_B_m, double radius_m) {
    stage.model.keypoints.push_back({name, object, 0, p_B_m, radius_m});
  };
  add("inside", {-0.5, 0, 0}, 0.25);  // 0.2 m behind the face
  add("too deep", {-0.5, 0, 0}, 0.15);
  add("behind the barrier", {0.66, 0, 0}, 0.25);
  add("beyond", {-4, 0, 0}, 0.25);
  add("behind the eye", {0, -6, 0}, 0.25);
  const ObjectBox box = BoxOf(stage.Shoot(Pinhole(), kAhead), object);
  ASSERT_EQ(box.keypoints.size(), 5u);
  EXPECT_EQ(box.keypoints[0].sight, KeypointSight::kSeen);
  ASSERT_TRUE(box.keypoints[0].pixel_px);
  EXPECT_NEAR(box.keypoints[0].pixel_px->x(), 163.2 - 260 * 0.5 / 5, 1e-6);
  EXPECT_NEAR(box.keypoints[0].pixel_px->y(), 117.7, 1e-6);
  EXPECT_LT((box.keypoints[0].p_C_m - Vec3(-0.5, 0, 5)).norm(), 1e-9);
  EXPECT_EQ(box.keypoints[1].sight, KeypointSight::kHidden);
  EXPECT_EQ(box.keypoints[2].sight, KeypointSight::kHidden);
  EXPECT_EQ(box.keypoints[3].sight, KeypointSight::kOutside);
  EXPECT_TRUE(box.keypoints[3].pixel_px);
  EXPECT_EQ(box.keypoints[4].sight, KeypointSight::kOutside);
  EXPECT_FALSE(box.keypoints[4].pixel_px);
}

}  // namespace
}  // namespace tera
