#pragma once

#include <cmath>
#include <utility>

#include "render/gl/rasterizer.h"

/// Boxes on a terrain before a camera, for the rasterizer's tests.

namespace tera {

/// An axis-aligned box of the given half sizes about the mesh origin, with flat normals.
inline Mesh BoxMesh(const Vec3& half_m, const Vec3& albedo) {
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

inline TerrainSurface Ground(int cells, double cell_m, double (*height_m)(double, double)) {
  TerrainSurface t(TerrainGrid{.origin_W_m = Vec2::Constant(-0.5 * cells * cell_m),
                               .cell_m = cell_m,
                               .nx = cells + 1,
                               .ny = cells + 1});
  for (int j = 0; j < t.ny; ++j) {
    for (int i = 0; i < t.nx; ++i) {
      t.Set(i, j, {static_cast<float>(height_m(t.x_m(i), t.y_m(j))), {}});
    }
  }
  return t;
}

inline double Level(double, double) { return 0.0; }
inline double Slope(double x, double y) { return 0.2 * x - 0.1 * y; }
inline double Waves(double x, double y) { return 0.2 * std::sin(0.9 * x) * std::cos(0.7 * y); }

/// Optical frame at `eye` looking at `target`, image rows level.
inline Pose LookAt(const Vec3& eye_W_m, const Vec3& target_W_m) {
  Mat3 R;
  R.col(2) = (target_W_m - eye_W_m).normalized();
  R.col(0) = R.col(2).cross(Vec3::UnitZ()).normalized();
  R.col(1) = R.col(2).cross(R.col(0));
  return MakePose(eye_W_m, R);
}

inline CameraIntrinsics Pinhole() {
  CameraIntrinsics c;
  c.width_px = 320;
  c.height_px = 240;
  c.fx_px = 260;
  c.fy_px = 255;
  c.cx_px = 163.2;
  c.cy_px = 117.7;
  return c;
}

inline CameraIntrinsics WideLens() {
  CameraIntrinsics c = Pinhole();
  c.k1 = -0.27;
  c.k2 = 0.08;
  c.p1 = 0.0007;
  c.p2 = -0.0005;
  c.k3 = -0.009;
  return c;
}

/// OpenCV's rational model, with values typical of calibrated wide lenses.
inline CameraIntrinsics RationalLens() {
  CameraIntrinsics c = Pinhole();
  c.kind = LensKind::kRational;
  c.k1 = 0.62;
  c.k2 = 0.05;
  c.p1 = 0.0007;
  c.p2 = -0.0005;
  c.k3 = 0.002;
  c.k4 = 0.93;
  c.k5 = 0.19;
  c.k6 = 0.01;
  return c;
}

/// A fisheye of 200 degrees, whose image circle is cut above and below.
inline CameraIntrinsics Fisheye() {
  CameraIntrinsics c = Pinhole();
  c.kind = LensKind::kKannalaBrandt;
  c.fx_px = 85;
  c.fy_px = 84;
  c.k1 = 0.021;
  c.k2 = -0.009;
  c.k3 = 0.0012;
  c.k4 = -0.0001;
  c.field_rad = 3.4906585;
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

/// Mean over a plate's picture of its pixel position, by the area that each part takes up.
inline Vec2 ProjectedMean(const CameraIntrinsics& camera, const Pose& X_CO, double half_m) {
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

inline const Vec3 kEye(2.3, -6.1, 2.4), kTarget(0.4, 0.6, 0.5);

inline double Grey(const CameraFrame& f, int x, int y) {
  return (f.rgb.at(x, y, 0) + f.rgb.at(x, y, 1) + f.rgb.at(x, y, 2)) / 3.0;
}

}  // namespace tera
