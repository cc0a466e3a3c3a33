#include "render/rasterizer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "core/units.h"

namespace tera {
namespace {

/// An axis-aligned box of the given half sizes about the mesh origin, with flat normals.
Mesh BoxMesh(const Vec3& half_m, const Vec3& albedo) {
  MeshPart part;
  part.material.albedo = albedo;
  for (int axis = 0; axis < 3; ++axis) {
    for (const float sign : {-1.0f, 1.0f}) {
      const Eigen::Vector3f n = sign * Eigen::Vector3f::Unit(axis);
      const Eigen::Vector3f a = Eigen::Vector3f::Unit((axis + 1) % 3), b = n.cross(a);
      const auto base = static_cast<std::uint32_t>(part.positions_m.size());
      for (const auto& [s, t] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
        part.positions_m.push_back((n + a * s + b * t).cwiseProduct(half_m.cast<float>()));
        part.normals.push_back(n);
      }
      for (std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) part.indices.push_back(base + i);
    }
  }
  Mesh mesh;
  mesh.name = "box";
  mesh.parts.push_back(part);
  return mesh;
}

TerrainSurface Ground(int cells, double cell_m, double (*height_m)(double, double)) {
  TerrainSurface t;
  t.nx = t.ny = cells + 1;
  t.cell_m = cell_m;
  t.origin_W_m = Vec2::Constant(-0.5 * cells * cell_m);
  const std::size_t n = static_cast<std::size_t>(t.nx) * t.ny;
  for (int j = 0; j < t.ny; ++j) {
    for (int i = 0; i < t.nx; ++i) {
      t.height_m.push_back(static_cast<float>(
          height_m(t.origin_W_m.x() + i * cell_m, t.origin_W_m.y() + j * cell_m)));
    }
  }
  t.soil.assign(n, 0);
  t.moisture.assign(n, 0);
  t.looseness.assign(n, 0);
  t.rut.assign(n, 0);
  t.tile_version.assign(static_cast<std::size_t>(t.tiles_x()) * t.tiles_y(), 1);
  return t;
}

double Level(double, double) { return 0.0; }
double Slope(double x, double y) { return 0.2 * x - 0.1 * y; }
double Waves(double x, double y) { return 0.2 * std::sin(0.9 * x) * std::cos(0.7 * y); }

/// Optical frame at `eye` looking at `target`, image rows level.
Pose LookAt(const Vec3& eye_W_m, const Vec3& target_W_m) {
  Mat3 R;
  R.col(2) = (target_W_m - eye_W_m).normalized();
  R.col(0) = R.col(2).cross(Vec3::UnitZ()).normalized();
  R.col(1) = R.col(2).cross(R.col(0));
  return MakePose(eye_W_m, R);
}

CameraIntrinsics Pinhole() {
  CameraIntrinsics c;
  c.width_px = 320;
  c.height_px = 240;
  c.fx_px = 260;
  c.fy_px = 255;
  c.cx_px = 163.2;
  c.cy_px = 117.7;
  return c;
}

CameraIntrinsics WideLens() {
  CameraIntrinsics c = Pinhole();
  c.k1 = -0.27;
  c.k2 = 0.08;
  c.p1 = 0.0007;
  c.p2 = -0.0005;
  c.k3 = -0.009;
  return c;
}

struct Stage {
  SceneModel model;
  SceneState state;
  TerrainSurface terrain;

  Stage() { model.instances.push_back({"none"}); }
  void SetTerrain(const TerrainSurface& t) {
    terrain = t;
    state.terrain = &terrain;
  }
  std::uint16_t AddBox(const Pose& X_WB, const Vec3& half_m, SemanticClass label,
                       const Vec3& albedo = Vec3(0.5, 0.5, 0.5)) {
    const int body = model.body_count++;
    model.meshes.push_back(BoxMesh(half_m, albedo));
    model.instances.push_back({"box" + std::to_string(body), label, body, -half_m, half_m});
    SceneNode node;
    node.mesh = static_cast<int>(model.meshes.size()) - 1;
    node.body = body;
    node.label = label;
    node.instance = static_cast<std::uint16_t>(model.instances.size() - 1);
    model.nodes.push_back(node);
    state.X_WB.push_back(X_WB);
    return node.instance;
  }
  CameraFrame Shoot(const CameraIntrinsics& camera, const Pose& X_WC) const {
    return Rasterizer(model, EglOptions{}).Render(camera, X_WC, state);
  }
};

const Vec3 kEye(2.3, -6.1, 2.4), kTarget(0.4, 0.6, 0.5);

double Grey(const CameraFrame& f, int x, int y) {
  return (f.rgb.at(x, y, 0) + f.rgb.at(x, y, 1) + f.rgb.at(x, y, 2)) / 3.0;
}

TEST(Intrinsics, ProjectFollowsBrownConradyByHand) {
  CameraIntrinsics c = Pinhole();
  c.k1 = 0.1;
  c.k2 = 0.01;
  c.p1 = 0.001;
  c.p2 = 0.002;
  // x = 1/2, y = 1/4: r2 = 0.3125, radial = 1 + 0.03125 + 0.0009765625 = 1.0322265625;
  // x' = 0.51611328125 + 0.00025 + 0.001625 = 0.51798828125, y' = 0.258056640625 + 0.0004375 +
  // 0.0005.
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
      const Vec3 ray_C = camera.Unproject(Vec2(u, v));
      const double z_m = height_m / n_C.dot(ray_C);
      const Vec3 p_W = X_WC * Vec3(ray_C * z_m);
      if (z_m < 0 || p_W.head<2>().cwiseAbs().maxCoeff() > 9.5) continue;
      EXPECT_NEAR(frame.depth_m.at(u, v), z_m, 1e-3) << u << " " << v;
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
      // Slab test; rays that pass within 2 px of an edge are left out by testing neighbours.
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
  EXPECT_GT(hits, 100);
}

INSTANTIATE_TEST_SUITE_P(Lenses, RasterizerDepth, testing::Values(Pinhole(), WideLens()));

class RasterizerProjection : public testing::TestWithParam<CameraIntrinsics> {};

/// Mean over a plate's picture of its pixel position, by the area that each part takes up.
Vec2 ProjectedMean(const CameraIntrinsics& camera, const Pose& X_CO, double half_m) {
  Vec2 sum = Vec2::Zero();
  double weight = 0;
  constexpr int kParts = 8;
  for (int i = -kParts; i <= kParts; ++i) {
    for (int j = -kParts; j <= kParts; ++j) {
      const Vec3 p_O = Vec3(i, j, 0) * (half_m / (kParts + 0.5));
      constexpr double kStep = 1e-4;
      const Vec2 c = camera.Project(X_CO * p_O);
      const Vec2 a = camera.Project(X_CO * Vec3(p_O + Vec3(kStep, 0, 0))) - c;
      const Vec2 b = camera.Project(X_CO * Vec3(p_O + Vec3(0, kStep, 0))) - c;
      const double area = std::abs(a.x() * b.y() - a.y() * b.x());
      sum += area * c;
      weight += area;
    }
  }
  return sum / weight;
}

/// Thin square plates facing the camera; the centroid of the pixels of each against its projected
/// mean. Pixel quantisation: the centroid of a plate of about 400 px whose borders fall anywhere
/// within pixels errs by about 0.29 px / sqrt(80 px of border) = 0.03 px, and more where a border
/// runs along a direction of the grid. Over 16 shifts of the picture by parts of a pixel, which
/// average the border's place within pixels, 0.1 px is over 5 standard errors for a plate.
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

INSTANTIATE_TEST_SUITE_P(Lenses, RasterizerProjection, testing::Values(Pinhole(), WideLens()));

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

TEST(Rasterizer, SendsOnlyChangedTiles) {
  Stage stage;
  stage.SetTerrain(Ground(200, 0.1, Waves));
  Rasterizer rasterizer(stage.model, EglOptions{});
  const Pose X_WC = LookAt(kEye, kTarget);
  rasterizer.Render(Pinhole(), X_WC, stage.state);
  EXPECT_EQ(rasterizer.uploaded_tiles(), 16);
  rasterizer.Render(Pinhole(), X_WC, stage.state);
  EXPECT_EQ(rasterizer.uploaded_tiles(), 16);
  // A hill in the middle of tile (1, 1), which spans (-5, -5) to (0, 0).
  for (float& h : stage.terrain.height_m) h += 0.0f;
  stage.terrain.height_m[stage.terrain.index(75, 75)] += 0.5f;
  ++stage.terrain.tile_version[1 * 4 + 1];
  const CameraFrame after = rasterizer.Render(Pinhole(), X_WC, stage.state);
  EXPECT_EQ(rasterizer.uploaded_tiles(), 17);
  EXPECT_EQ(after.rgb.data, stage.Shoot(Pinhole(), X_WC).rgb.data)
      << "a picture must not depend on which pictures came before";
}

TEST(Rasterizer, CoarserTilesStayWithinTheirHeightError) {
  Stage stage;
  stage.SetTerrain(Ground(400, 0.1, Waves));
  const CameraIntrinsics camera = Pinhole();
  const Pose X_WC = LookAt(Vec3(2, -18, 6), Vec3(0, 5, 0));
  const CameraFrame frame = stage.Shoot(camera, X_WC);
  int checked = 0;
  for (int v = 20; v < 240; v += 6) {
    for (int u = 10; u < 310; u += 6) {
      const double z_m = frame.depth_m.at(u, v);
      if (z_m <= 0) continue;
      const Vec3 p_W = X_WC * Vec3(camera.Unproject(Vec2(u, v)) * z_m);
      if (p_W.head<2>().cwiseAbs().maxCoeff() > 19) continue;
      EXPECT_NEAR(p_W.z(), stage.terrain.HeightAt(p_W.x(), p_W.y()), 0.02 + 1e-3);
      ++checked;
    }
  }
  EXPECT_GT(checked, 500);
}

TEST(Rasterizer, ABoxShadesTheGroundAwayFromTheSun) {
  Stage stage;
  stage.SetTerrain(Ground(200, 0.1, Level));
  stage.model.environment.to_sun_W = Vec3(1, 0, 1).normalized();
  stage.AddBox(MakePose(Vec3(0, 0, 1)), Vec3(0.5, 0.5, 1.0), SemanticClass::kRock);
  const CameraIntrinsics camera = Pinhole();
  const Pose X_WC = LookAt(Vec3(0.2, -8, 7), Vec3(0, 0, 0));
  const auto grey = [&](const CameraFrame& f, double x, double y) {
    const Vec2 p = camera.Project(X_WC.inverse() * Vec3(x, y, 0));
    double sum = 0;
    for (int v = -2; v <= 2; ++v) {
      for (int u = -2; u <= 2; ++u) sum += Grey(f, std::lround(p.x()) + u, std::lround(p.y()) + v);
    }
    return sum / 25;
  };
  // Sun at 45 degrees from +x, box 2 m high: the shadow reaches from x = -0.5 to -2.5 m.
  const CameraFrame frame = stage.Shoot(camera, X_WC);
  EXPECT_LT(grey(frame, -1.5, 0), 0.75 * grey(frame, 1.8, 0));
  EXPECT_LT(grey(frame, -2.2, 0), 0.75 * grey(frame, 1.8, 0));
  EXPECT_NEAR(grey(frame, -3.2, 0), grey(frame, 2.4, 0), 0.15 * grey(frame, 2.4, 0));
  // With the sun on the other side, the shadow changes sides.
  stage.model.environment.to_sun_W = Vec3(-1, 0, 1).normalized();
  const CameraFrame other = stage.Shoot(camera, X_WC);
  EXPECT_LT(grey(other, 1.5, 0), 0.75 * grey(other, -1.8, 0));
}

TEST(Rasterizer, TheGroundShadesItself) {
  Stage stage;
  // A wall of earth 1 m high along y at x = 0; sun at 45 degrees from +x.
  stage.SetTerrain(
      Ground(200, 0.1, [](double x, double) { return std::abs(x) < 0.25 ? 1.0 : 0.0; }));
  stage.model.environment.to_sun_W = Vec3(1, 0, 1).normalized();
  const CameraIntrinsics camera = Pinhole();
  const Pose X_WC = LookAt(Vec3(0.2, -6, 8), Vec3(0, 0, 0));
  const CameraFrame frame = stage.Shoot(camera, X_WC);
  const auto grey = [&](double x) {
    double sum = 0;
    for (int k = -10; k <= 10; ++k) {
      const Vec2 p = camera.Project(X_WC.inverse() * Vec3(x, 0.1 * k, 0));
      sum += Grey(frame, std::lround(p.x()), std::lround(p.y()));
    }
    return sum / 21;
  };
  EXPECT_LT(grey(-0.8), 0.8 * grey(1.5));
  EXPECT_NEAR(grey(-2.0), grey(2.0), 0.12 * grey(2.0));
}

TEST(Rasterizer, BodyScaleShrinksAndHides) {
  Stage stage;
  stage.AddBox(MakePose(kTarget), Vec3(0.4, 0.4, 0.4), SemanticClass::kSoilInBucket);
  Rasterizer rasterizer(stage.model, EglOptions{});
  const Pose X_WC = LookAt(kEye, kTarget);
  const auto pixels = [&](float scale) -> double {
    stage.state.body_scale = {scale};
    const CameraFrame frame = rasterizer.Render(Pinhole(), X_WC, stage.state);
    return frame.boxes.empty() ? 0.0 : static_cast<double>(frame.boxes[0].visible_px);
  };
  const double whole = pixels(1.0f);
  // Half the size is a quarter of the area, a little less as the near side recedes.
  EXPECT_NEAR(pixels(0.5f) / whole, 0.25, 0.03);
  EXPECT_EQ(pixels(0.0f), 0);
}

TEST(Rasterizer, NothingNearerThanNearOrDeeperThanFarIsMeasured) {
  Stage stage;
  stage.AddBox(MakePose(Vec3(0, 3, 1)), Vec3(5, 0.05, 5), SemanticClass::kStructure);
  CameraIntrinsics camera = Pinhole();
  const Pose X_WC = LookAt(Vec3(0, 0, 1), Vec3(0, 3, 1));
  EXPECT_NEAR(stage.Shoot(camera, X_WC).depth_m.at(160, 120), 2.95, 1e-3);
  camera.far_m = 2.5;
  EXPECT_EQ(stage.Shoot(camera, X_WC).depth_m.at(160, 120), 0.0f);
  camera = Pinhole();
  camera.near_m = 4.0;
  EXPECT_EQ(stage.Shoot(camera, X_WC).instance.at(160, 120), 0);
}

TEST(Rasterizer, TheSameSceneGivesTheSameBytes) {
  Stage stage;
  stage.SetTerrain(Ground(100, 0.1, Waves));
  stage.AddBox(MakePose(kTarget, 0.1, 0.2, 0.3), Vec3(0.4, 0.5, 0.6), SemanticClass::kRock);
  const Pose X_WC = LookAt(kEye, kTarget);
  const CameraFrame a = stage.Shoot(WideLens(), X_WC), b = stage.Shoot(WideLens(), X_WC);
  EXPECT_EQ(a.rgb.data, b.rgb.data);
  EXPECT_EQ(a.depth_m.data, b.depth_m.data);
  EXPECT_EQ(a.instance.data, b.instance.data);
}

TEST(Rasterizer, FogLeavesTwoPercentContrastAtTheVisibility) {
  // A black and a white plate at range V: with fog, the difference of their radiances falls to 2 %
  // of what it is in clear air. Exposure is chosen so that the tone curve does not saturate; what
  // is compared is the sRGB difference, which for so small a contrast is below 6 % of full scale.
  Stage stage;
  const Vec3 half_m(20, 0.1, 20);
  stage.AddBox(MakePose(Vec3(-25, 200, 25)), half_m, SemanticClass::kStructure, Vec3::Zero());
  stage.AddBox(MakePose(Vec3(25, 200, 25)), half_m, SemanticClass::kStructure, Vec3(1, 1, 1));
  stage.model.environment.to_sun_W = Vec3(0, -1, 1).normalized();
  CameraIntrinsics camera = Pinhole();
  const Pose X_WC = LookAt(Vec3(0, 0, 25), Vec3(0, 200, 25));
  const auto contrast = [&](double visibility_m) {
    stage.model.environment.fog_visibility_m = visibility_m;
    const CameraFrame frame = stage.Shoot(camera, X_WC);
    return Grey(frame, 163 + 32, 118) - Grey(frame, 163 - 32, 118);
  };
  EXPECT_GT(contrast(1e6), 100);
  EXPECT_LT(contrast(200), 0.06 * 255);
  EXPECT_GT(contrast(200), 0);
  EXPECT_GT(contrast(2000), contrast(500));
}

TEST(Rasterizer, RefusesALensThatFoldsThePicture) {
  Stage stage;
  CameraIntrinsics camera = Pinhole();
  camera.k1 = -2.0;
  EXPECT_THROW(stage.Shoot(camera, LookAt(kEye, kTarget)), InputError);
}

TEST(Rasterizer, RefusesAnEglDeviceThatIsNotThere) {
  Stage stage;
  EglOptions options;
  options.device = 31;
  try {
    Rasterizer rasterizer(stage.model, options);
    FAIL() << "no InputError";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr("EGL device 31 asked for"));
  }
}

}  // namespace
}  // namespace tera
