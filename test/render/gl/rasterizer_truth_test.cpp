#include <gtest/gtest.h>

#include <cmath>
#include <ostream>

#include "core/units.h"
#include "rasterizer_stage.h"
#include "render/gl/rasterizer.h"

/// Places in the picture: projection, depth, labels and boxes.

namespace tera {

/// Name of a lens in a parametrised test.
static void PrintTo(const CameraIntrinsics& camera, std::ostream* out) {
  *out << camera.width_px << " x " << camera.height_px << " px"
       << (camera.Distorted() ? ", distorted" : "");
}

namespace {

TEST(Intrinsics, ProjectFollowsBrownConradyByHand) {
  CameraIntrinsics c = Pinhole();
  c.k1 = 0.1;
  c.k2 = 0.01;
  c.p1 = 0.001;
  c.p2 = 0.002;
  // x = 1/2, y = 1/4: r2 = 0.3125, radial = 1 + 0.03125 + 0.0009765625 = 1.0322265625. x' =
  // 0.51611328125 + 0.00025 + 0.001625 = 0.51798828125, y' = 0.258056640625 + 0.0004375 + 0.0005.
  const Vec2 p = c.Project(Vec3(1.0, 0.5, 2.0));
  EXPECT_NEAR(p.x(), 260 * 0.51798828125 + 163.2, 1e-9);
  EXPECT_NEAR(p.y(), 255 * 0.258994140625 + 117.7, 1e-9);
}

TEST(Intrinsics, UnprojectUndoesProject) {
  const CameraIntrinsics c = WideLens();
  for (int v = 0; v < c.height_px; v += 17) {
    for (int u = 0; u < c.width_px; u += 13) {
      EXPECT_LT((c.Project(c.Unproject(Vec2(u, v))) - Vec2(u, v)).norm(), 1e-8) << u << " " << v;
    }
  }
}

class RasterizerDepth : public testing::TestWithParam<CameraIntrinsics> {};

TEST_P(RasterizerDepth, OfASlopeIsThatOfItsPlane) {
  Stage stage;
  stage.SetTerrain(Ground(200, 0.1, Slope));
  const CameraIntrinsics camera = GetParam();
  const Pose X_WC = LookAt(kEye, kTarget);
  const CameraFrame frame = stage.Shoot(camera, X_WC);
  const Vec3 n_C = X_WC.linear().transpose() * Vec3(-0.2, 0.1, 1);
  const double height_m = Slope(kEye.x(), kEye.y()) - kEye.z();
  int checked = 0;
  for (int v = 5; v < camera.height_px; v += 7) {
    for (int u = 3; u < camera.width_px; u += 5) {
      if (!camera.RayOf(Vec2(u, v))) continue;  // beyond the field
      const auto depth_m = [&](double at_u, double at_v) {
        return height_m / n_C.dot(camera.Unproject(Vec2(at_u, at_v)));
      };
      const double z_m = depth_m(u, v);
      const Vec3 p_W = X_WC * Vec3(camera.Unproject(Vec2(u, v)) * z_m);
      if (z_m < 0 || p_W.head<2>().cwiseAbs().maxCoeff() > 9.5) continue;
      // Drivers round the vertices of a triangle to fractions of a pixel, NVIDIA's and Mesa's to
      // 1/256. For a fisheye, that applies to the pictures that compose its own.
      const double rounded_m =
          (std::abs(depth_m(u + 1, v) - z_m) + std::abs(depth_m(u, v + 1) - z_m)) /
          (camera.IsAngular() ? 64 : 256);
      EXPECT_NEAR(frame.depth_m.at(u, v), z_m, 1e-4 + rounded_m) << u << " " << v;
      EXPECT_EQ(frame.semantic.at(u, v), static_cast<int>(SemanticClass::kTerrain));
      ++checked;
    }
  }
  EXPECT_GT(checked, 500);
}

TEST_P(RasterizerDepth, OfATurnedBoxIsThatOfItsFaces) {
  Stage stage;
  const Pose X_WB = MakePose(Vec3(0.3, 0.8, 0.9), 0.3, -0.5, 0.7);
  const Vec3 half_m(0.8, 0.6, 0.5);
  stage.AddBox(X_WB, half_m, SemanticClass::kRock);
  const CameraIntrinsics camera = GetParam();
  const Pose X_WC = LookAt(kEye, kTarget);
  const CameraFrame frame = stage.Shoot(camera, X_WC);
  const Vec3 eye_B = X_WB.inverse() * kEye;
  int hits = 0;
  for (int v = 0; v < camera.height_px; v += 3) {
    for (int u = 0; u < camera.width_px; u += 3) {
      if (!camera.RayOf(Vec2(u, v))) continue;  // beyond the field
      // Slab test; tests of neighbours exclude rays within 2 px of an edge.
      const auto hit = [&](double du, double dv) {
        const Vec3 ray_B =
            X_WB.linear().transpose() * X_WC.linear() * camera.Unproject(Vec2(u + du, v + dv));
        double in = 0, out = 1e9;
        int face = -1;
        for (int k = 0; k < 3; ++k) {
          const double a = (-half_m[k] - eye_B[k]) / ray_B[k],
                       b = (half_m[k] - eye_B[k]) / ray_B[k];
          if (std::min(a, b) > in) face = k;
          in = std::max(in, std::min(a, b));
          out = std::min(out, std::max(a, b));
        }
        return std::pair{in < out ? in : 0.0, in < out ? face : -1};
      };
      const auto [z_m, face] = hit(0, 0);
      bool inner = true;
      for (const auto& [du, dv] : {std::pair{2, 2}, {-2, 2}, {2, -2}, {-2, -2}}) {
        inner &= hit(du, dv).second == face;
      }
      if (!inner) continue;
      EXPECT_NEAR(frame.depth_m.at(u, v), z_m, 1e-3);
      EXPECT_EQ(frame.instance.at(u, v), z_m > 0 ? 1 : 0);
      hits += z_m > 0;
    }
  }
  EXPECT_GT(hits, camera.IsAngular() ? 5 : 100);  // much smaller through a fisheye
}

INSTANTIATE_TEST_SUITE_P(Lenses, RasterizerDepth,
                         testing::Values(Pinhole(), WideLens(), RationalLens(), Fisheye()));

class RasterizerProjection : public testing::TestWithParam<CameraIntrinsics> {};

/// Thin square plates facing the camera: the centroid of each one's pixels against its projected
/// mean. The centroid of a plate of about 400 px, with borders anywhere within pixels, errs by
/// about 0.29 px / sqrt(80 px of border) = 0.03 px. It errs more where a border follows the grid.
/// 16 shifts of the picture by fractions of a pixel average the border's place, so that 0.1 px is
/// over 5 standard errors for a plate.
TEST_P(RasterizerProjection, TruthPointsLandOnTheirFeatures) {
  Stage stage;
  const Pose X_WC = LookAt(kEye, kTarget);
  constexpr double kHalf_m = 0.17;
  std::vector<Pose> plates_C;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 6; ++column) {
      const Vec2 pixel_px(27.37 + 52.83 * column + 0.71 * row, 26.19 + 60.57 * row + 0.43 * column);
      const double z_m = 3.2 + 0.3 * column + 0.17 * row;
      plates_C.push_back(
          MakePose(GetParam().Unproject(pixel_px) * z_m, 0, 0, 0.31 + 0.07 * column + 0.02 * row));
      stage.AddBox(X_WC * plates_C.back(), Vec3(kHalf_m, kHalf_m, 1e-4), SemanticClass::kCone);
    }
  }
  Rasterizer rasterizer(stage.model, EglOptions{});
  std::vector<Vec2> error(plates_C.size(), Vec2::Zero());
  constexpr int kShifts = 4;
  for (int shift = 0; shift < kShifts * kShifts; ++shift) {
    CameraIntrinsics camera = GetParam();
    camera.cx_px += static_cast<double>(shift % kShifts) / kShifts;
    camera.cy_px += static_cast<double>(shift / kShifts) / kShifts;
    const CameraFrame frame = rasterizer.Render(camera, X_WC, stage.state);
    std::vector<Vec2> sum(plates_C.size(), Vec2::Zero());
    std::vector<int> count(plates_C.size(), 0);
    for (int v = 0; v < camera.height_px; ++v) {
      for (int u = 0; u < camera.width_px; ++u) {
        const int k = frame.instance.at(u, v) - 1;
        if (k < 0) continue;
        sum[k] += Vec2(u, v);
        ++count[k];
      }
    }
    for (std::size_t k = 0; k < plates_C.size(); ++k) {
      ASSERT_GT(count[k], 100) << k;
      error[k] +=
          (sum[k] / count[k] - ProjectedMean(camera, plates_C[k], kHalf_m)) / (kShifts * kShifts);
    }
  }
  for (std::size_t k = 0; k < error.size(); ++k) EXPECT_LT(error[k].norm(), 0.1) << k;
}

INSTANTIATE_TEST_SUITE_P(Lenses, RasterizerProjection,
                         testing::Values(Pinhole(), WideLens(), RationalLens()));

TEST(Rasterizer, HalfHiddenBoxIsHalfVisible) {
  Stage stage;
  // Seen from -y; the second plate covers the right half of the first.
  const auto behind = stage.AddBox(MakePose(Vec3(0, 2, 1)), Vec3(1, 0.01, 1), SemanticClass::kRock);
  const auto before =
      stage.AddBox(MakePose(Vec3(1.0, 1.9, 1)), Vec3(1, 0.01, 1.5), SemanticClass::kBarrier);
  const CameraFrame frame = stage.Shoot(Pinhole(), LookAt(Vec3(0, -8, 1), Vec3(0, 0, 1)));
  ASSERT_EQ(frame.boxes.size(), 2u);
  EXPECT_EQ(frame.boxes[0].instance, behind);
  // One column of about 52 is a fiftieth.
  EXPECT_NEAR(frame.boxes[0].visibility, 0.5, 0.02);
  EXPECT_EQ(frame.boxes[1].instance, before);
  EXPECT_EQ(frame.boxes[1].visibility, 1.0);
  EXPECT_EQ(frame.boxes[0].size_O_m, Vec3(2, 0.02, 2));
  EXPECT_NEAR(frame.boxes[0].X_CO.translation().z(), 10.0, 1e-9);
}

TEST(Rasterizer, BoxesAreTightAroundTheirPixels) {
  Stage stage;
  stage.AddBox(MakePose(Vec3(0.3, 0.8, 0.9), 0.3, -0.5, 0.7), Vec3(0.8, 0.6, 0.5),
               SemanticClass::kTruck);
  const CameraFrame frame = stage.Shoot(WideLens(), LookAt(kEye, kTarget));
  ASSERT_EQ(frame.boxes.size(), 1u);
  int x_min = 999, x_max = -1, count = 0;
  for (int v = 0; v < 240; ++v) {
    for (int u = 0; u < 320; ++u) {
      if (frame.instance.at(u, v) != 1) continue;
      EXPECT_EQ(frame.semantic.at(u, v), static_cast<int>(SemanticClass::kTruck));
      x_min = std::min(x_min, u);
      x_max = std::max(x_max, u);
      ++count;
    }
  }
  EXPECT_EQ(frame.boxes[0].x_min_px, x_min);
  EXPECT_EQ(frame.boxes[0].x_max_px, x_max);
  EXPECT_EQ(frame.boxes[0].visible_px, count);
  EXPECT_EQ(frame.boxes[0].visibility, 1.0);
}

}  // namespace
}  // namespace tera
