#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "core/types/surface_normal.h"
#include "core/units.h"
#include "rasterizer_stage.h"
#include "render/gl/rasterizer.h"

/// Pictures of surface normals, against geometry.

namespace tera {
namespace {

LabelSet Normals() {
  LabelSet labels;
  labels.set(kNormalChannel);
  return labels;
}

CameraFrame Shoot(const Stage& stage, const CameraIntrinsics& camera, const Pose& X_WC) {
  return Rasterizer(stage.model, EglOptions{}).Render(camera, X_WC, stage.state, Normals());
}

/// A ball of 96 x 192 flat triangles with the sphere's own normals at their corners.
Mesh BallMesh(double radius_m) {
  constexpr std::uint32_t kRings = 96, kAround = 192;
  MeshPart part;
  for (std::uint32_t ring = 0; ring <= kRings; ++ring) {
    for (std::uint32_t k = 0; k <= kAround; ++k) {
      const double polar = kPi * ring / kRings, turn = 2 * kPi * k / kAround;
      const Vec3 n(std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn),
                   std::cos(polar));
      part.normals.push_back(n.cast<float>());
      part.positions_m.push_back((radius_m * n).cast<float>());
    }
  }
  for (std::uint32_t ring = 0; ring < kRings; ++ring) {
    for (std::uint32_t k = 0; k < kAround; ++k) {
      const std::uint32_t a = ring * (kAround + 1) + k, b = a + kAround + 1;
      for (const std::uint32_t corner : {a, b, a + 1, a + 1, b, b + 1}) {
        part.indices.push_back(corner);
      }
    }
  }
  Mesh mesh;
  mesh.name = "ball";
  mesh.parts.push_back(part);
  return mesh;
}

class NormalPicture : public testing::TestWithParam<CameraIntrinsics> {};

TEST_P(NormalPicture, OfATiltedPlateIsThePlatesNormal) {
  Stage stage;
  const Pose X_WB = MakePose(Vec3(0.3, 0.8, 0.4), 0.35, -0.25, 0.7);
  const Vec3 half_m(2.0, 1.6, 0.05);
  stage.AddBox(X_WB, half_m, SemanticClass::kStructure);
  const CameraIntrinsics camera = GetParam();
  const Pose X_WC = LookAt(kEye, kTarget);
  const CameraFrame frame = Shoot(stage, camera, X_WC);
  const Pose X_BC = X_WB.inverse() * X_WC;
  const Vec3 n_C = X_BC.linear().transpose() * Vec3::UnitZ();
  ASSERT_GT(X_BC.translation().z(), half_m.z()) << "the camera stands above the plate";
  int on_plate = 0, beside = 0;
  for (int v = 0; v < camera.height_px; v += 5) {
    for (int u = 0; u < camera.width_px; u += 5) {
      const Vec3 ray_B = X_BC.linear() * camera.Unproject(Vec2(u, v));
      const double t = (half_m.z() - X_BC.translation().z()) / ray_B.z();
      const Vec3 p_B = X_BC.translation() + t * ray_B;
      const double beyond_m = t < 0 ? 1 : (p_B.cwiseAbs() - half_m).head<2>().maxCoeff();
      const std::optional<Vec3> seen = NormalAt(frame.normal, u, v);
      if (beyond_m < -0.1) {  // steps of the shader's 16 bits and of the picture's
        ASSERT_TRUE(seen) << u << " " << v;
        EXPECT_LT((*seen - n_C).norm(), 8e-5) << u << " " << v;
        ++on_plate;
      } else if (beyond_m > 0.5) {
        EXPECT_FALSE(seen) << u << " " << v;
        ++beside;
      }
    }
  }
  EXPECT_GT(on_plate, 300);
  EXPECT_GT(beside, 300);
}

TEST_P(NormalPicture, OfABallPointsFromItsMiddleTowardsTheCamera) {
  Stage stage;
  const double radius_m = 1.2;
  const Pose X_WB = MakePose(Vec3(0.3, 0.8, 0.9), 0.3, -0.5, 0.7);
  stage.AddBox(X_WB, Vec3::Constant(radius_m), SemanticClass::kRock);
  stage.model.meshes.back() = BallMesh(radius_m);
  const CameraIntrinsics camera = GetParam();
  const Pose X_WC = LookAt(kEye, kTarget);
  const CameraFrame frame = Shoot(stage, camera, X_WC);
  const Vec3 middle_C = X_WC.inverse() * X_WB.translation();
  int seen = 0;
  for (int v = 0; v < camera.height_px; v += 3) {
    for (int u = 0; u < camera.width_px; u += 3) {
      const Vec3 d_C = camera.Unproject(Vec2(u, v)).normalized();
      const double along_m = d_C.dot(middle_C);
      const double off_m = (middle_C - along_m * d_C).norm();
      if (off_m > 0.9 * radius_m) continue;
      const double range_m = along_m - std::sqrt(radius_m * radius_m - off_m * off_m);
      const auto n_C = NormalAt(frame.normal, u, v);
      ASSERT_TRUE(n_C) << u << " " << v;
      EXPECT_LT(n_C->dot(d_C), 0) << u << " " << v;
      // A lens takes the nearest pixel of a finer picture, at most 0.6 px off: 0.6 / 255 of the
      // range across, and at 0.9 of the radius 2.3 times as far on the ball.
      const double tolerance = camera.Distorted() ? 0.6 / 255 * range_m * 2.3 / radius_m : 2e-3;
      EXPECT_LT((*n_C - (range_m * d_C - middle_C) / radius_m).norm(), tolerance) << u << " " << v;
      ++seen;
    }
  }
  EXPECT_GT(seen, 300);
}

INSTANTIATE_TEST_SUITE_P(Lenses, NormalPicture, testing::Values(Pinhole(), WideLens()));

TEST(NormalPictures, AreTakenOnlyWhereAskedFor) {
  Stage stage;
  stage.AddBox(MakePose(Vec3(0.3, 0.8, 0.9), 0.3, -0.5, 0.7), Vec3(0.8, 0.6, 0.5),
               SemanticClass::kRock);
  EXPECT_TRUE(stage.Shoot(Pinhole(), LookAt(kEye, kTarget)).normal.empty());
}

}  // namespace
}  // namespace tera
