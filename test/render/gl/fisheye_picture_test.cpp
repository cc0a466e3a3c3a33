#include <gtest/gtest.h>

#include <cmath>

#include "core/units.h"
#include "render/gl/rasterizer_stage.h"

// Lenses that look sideways and behind: pictures composed of a cube's faces.

namespace tera {
namespace {

/// A frame in C that faces the eye from `distance_m` at an angle off the axis, its x turned about
/// the line of sight.
Pose Facing(double off_axis_rad, double about_rad, double distance_m, double turn_rad) {
  const Mat3 R =
      (Eigen::AngleAxisd(about_rad, Vec3::UnitZ()) *
       Eigen::AngleAxisd(off_axis_rad, Vec3::UnitY()) * Eigen::AngleAxisd(turn_rad, Vec3::UnitZ()))
          .toRotationMatrix();
  return MakePose(distance_m * R.col(2), R);
}

CameraIntrinsics LargeFisheye(LensKind kind) {
  CameraIntrinsics c = Fisheye();
  c.kind = kind;
  c.width_px = 560;
  c.height_px = 560;
  c.fx_px = 150;
  c.fy_px = 148;
  c.cx_px = 281.3;
  c.cy_px = 277.6;
  return c;
}

/// Mean pixel of the box's object.
Vec2 MeanPixel(const CameraFrame& frame, const ObjectBox& box) {
  Vec2 sum = Vec2::Zero();
  for (int v = box.y_min_px; v <= box.y_max_px; ++v) {
    for (int u = box.x_min_px; u <= box.x_max_px; ++u) {
      if (frame.instance.at(u, v) == box.instance) sum += Vec2(u, v);
    }
  }
  return sum / box.visible_px;
}

class FisheyePicture : public testing::TestWithParam<LensKind> {};

// As RasterizerProjection, with camera rotations by fractions of a pixel and plates of some 400 px.
// They lie across seams (45 degrees), to the side of and behind the eye. test/sensors checks the
// projection itself against OpenCV's.
TEST_P(FisheyePicture, ThingsLandWhereTheLensProjectsThem) {
  Stage stage;
  const Pose X_WC = LookAt(kEye, kTarget);
  constexpr double kHalf_m = 0.17, kDistance_m = 2.5;
  std::vector<Pose> plates_C;
  for (const double off_axis_deg : {14.0, 30.0, 38.0, 46.0, 62.0, 80.0, 91.0}) {
    for (int k = 0; k < 6; ++k) {
      const double about_rad = (60 * k + 7 + 0.5 * off_axis_deg) * kDeg;
      plates_C.push_back(Facing(off_axis_deg * kDeg, about_rad, kDistance_m + 0.1 * k, 0.3 * k));
      stage.AddBox(X_WC * plates_C.back(), Vec3(kHalf_m, kHalf_m, 1e-4), SemanticClass::kCone);
    }
  }
  const CameraIntrinsics camera = LargeFisheye(GetParam());
  Rasterizer rasterizer(stage.model, EglOptions{});
  std::vector<Vec2> error(plates_C.size(), Vec2::Zero());
  constexpr int kTurns = 8;
  for (int turn = 0; turn < kTurns; ++turn) {
    const Pose X_CD = MakePose(Vec3::Zero(), 0.37 * turn / camera.fx_px, 0.29 * turn / camera.fx_px,
                               0.41 * turn / camera.fx_px);
    const CameraFrame frame = rasterizer.Render(camera, X_WC * X_CD, stage.state);
    ASSERT_EQ(frame.boxes.size(), plates_C.size());
    for (std::size_t k = 0; k < plates_C.size(); ++k) {
      const ObjectBox& box = frame.boxes[k];
      EXPECT_GT(box.visibility, 0.97) << k;  // a neighbour may hide a corner
      ASSERT_GT(box.visible_px, 150) << k;
      const Vec2 expected = ProjectedMean(camera, X_CD.inverse() * plates_C[k], kHalf_m);
      error[k] += (MeanPixel(frame, box) - expected) / kTurns;
    }
  }
  // Pinhole pictures with rows along the lens' rows displace a plate at 30 degrees by 0.12 and 0.18
  // px, one at 38 degrees by 0.12 px: 5 and 2 of their pixels there are 3 and 1 of the lens'.
  for (std::size_t k = 0; k < error.size(); ++k) EXPECT_LT(error[k].norm(), 0.1) << k;
}

INSTANTIATE_TEST_SUITE_P(Laws, FisheyePicture,
                         testing::Values(LensKind::kKannalaBrandt, LensKind::kFTheta));

TEST(FisheyePicture, NothingIsSeenBeyondTheField) {
  Stage stage;
  stage.SetTerrain(Ground(100, 0.2, Level));
  CameraIntrinsics camera = LargeFisheye(LensKind::kKannalaBrandt);
  camera.field_rad = 150 * kDeg;
  const Pose X_WC = LookAt(kEye, kTarget);
  const CameraFrame frame = stage.Shoot(camera, X_WC);
  int dark = 0, lit = 0;
  for (int v = 0; v < camera.height_px; ++v) {
    for (int u = 0; u < camera.width_px; ++u) {
      const bool sees = camera.RayOf(Vec2(u, v)).has_value();
      const int light = frame.rgb.at(u, v, 0) + frame.rgb.at(u, v, 1) + frame.rgb.at(u, v, 2);
      if (sees) {
        lit += light > 0;
        continue;
      }
      EXPECT_EQ(light, 0);
      EXPECT_EQ(frame.depth_m.at(u, v), 0);
      EXPECT_EQ(frame.semantic.at(u, v), 0);
      ++dark;
    }
  }
  EXPECT_GT(dark, 100'000);
  EXPECT_GT(lit, 100'000);
}

// Level ground h below the eye lies at the distance h / sin(depression) along each ray, also to the
// side and behind.
TEST(FisheyePicture, DepthIsTheDistanceAlongTheRay) {
  Stage stage;
  stage.SetTerrain(Ground(200, 0.1, Level));
  const CameraIntrinsics camera = LargeFisheye(LensKind::kFTheta);
  const Pose X_WC = LookAt(Vec3(0.3, 0.2, 2.4), Vec3(0.5, 3, 1.4));
  const CameraFrame frame = stage.Shoot(camera, X_WC);
  int behind = 0;
  for (int v = 3; v < camera.height_px; v += 7) {
    for (int u = 3; u < camera.width_px; u += 7) {
      const auto ray_C = camera.RayOf(Vec2(u, v));
      if (!ray_C) continue;
      const Vec3 d_W = X_WC.linear() * *ray_C;
      if (d_W.z() > -0.35) continue;  // within 7 m: on existing ground
      EXPECT_NEAR(frame.depth_m.at(u, v), 2.4 / -d_W.z(), 2e-3) << u << " " << v;
      behind += ray_C->z() < 0;
    }
  }
  EXPECT_GT(behind, 20);
}

// Light on both sides of a seam differs by shading noise only, without a visible line.
TEST(FisheyePicture, SeamsDoNotShow) {
  Stage stage;
  stage.SetTerrain(Ground(200, 0.1, Level));
  const CameraIntrinsics camera = LargeFisheye(LensKind::kKannalaBrandt);
  const Pose X_WC = LookAt(Vec3(0.3, 0.2, 2.4), Vec3(0.5, 3, 1.4));
  const CameraFrame frame = stage.Shoot(camera, X_WC);
  double across = 0, beside = 0;
  int pairs = 0;
  for (int v = 300; v < 500; ++v) {
    for (int u = 20; u < 540; ++u) {
      const auto here = camera.RayOf(Vec2(u, v)), next = camera.RayOf(Vec2(u + 1, v)),
                 last = camera.RayOf(Vec2(u - 2, v));
      if (!here || !next || !last) continue;
      const auto is_side = [](const Vec3& d) { return std::abs(d.x()) > std::abs(d.z()); };
      if (is_side(*here) == is_side(*next)) continue;
      across += std::abs(Grey(frame, u, v) - Grey(frame, u + 1, v));
      beside += std::abs(Grey(frame, u - 2, v) - Grey(frame, u - 1, v));
      ++pairs;
    }
  }
  ASSERT_GT(pairs, 100);
  EXPECT_LT(across / pairs, 1.5 * beside / pairs + 1);
}

}  // namespace
}  // namespace tera
