#include "render/meshes/grain_shape.h"

#include <cmath>

namespace tera {
namespace {

constexpr float kUneven = 0.22f;   ///< relative radial variation of the corners
constexpr float kTurn_rad = 2.4f;  ///< rotation between consecutive clods, the golden angle

GrainShape MakeGrain() {
  GrainShape shape;
  const float golden = 0.5f * (1 + std::sqrt(5.0f));
  int n = 0;
  for (const float a : {-1.0f, 1.0f}) {
    for (const float b : {-golden, golden}) {
      shape.corners[n++] = {0, a, b};
      shape.corners[n++] = {a, b, 0};
      shape.corners[n++] = {b, 0, a};
    }
  }
  // Corners at the edge length 2 from each other form a face.
  int face = 0;
  const auto near = [&](int i, int j) {
    return (shape.corners[i] - shape.corners[j]).norm() < 2.1f;
  };
  for (int i = 0; i < 12; ++i) {
    for (int j = i + 1; j < 12; ++j) {
      for (int k = j + 1; k < 12; ++k) {
        if (!near(i, j) || !near(j, k) || !near(i, k)) continue;
        const Eigen::Vector3f &a = shape.corners[i], &b = shape.corners[j], &c = shape.corners[k];
        const bool outward = (b - a).cross(c - a).dot(a) > 0;
        shape.faces[face++] = {static_cast<std::uint8_t>(i),
                               static_cast<std::uint8_t>(outward ? j : k),
                               static_cast<std::uint8_t>(outward ? k : j)};
      }
    }
  }
  for (int i = 0; i < 12; ++i) {
    shape.corners[i] *=
        (1 + kUneven * std::sin(2.4f * static_cast<float>(i * i))) / shape.corners[i].norm();
  }
  return shape;
}

}  // namespace

const GrainShape& UnitGrain() {
  static const GrainShape shape = MakeGrain();
  return shape;
}

Eigen::Affine3f GrainToWorld(const TerrainSurface::Grain& grain) {
  const float angle_rad = kTurn_rad * static_cast<float>(grain.number % 1024);
  const Eigen::Vector3f axis =
      Eigen::Vector3f(std::sin(angle_rad), std::cos(1.7f * angle_rad), 0.6f).normalized();
  return Eigen::Translation3f(grain.p_W_m) * Eigen::AngleAxisf(angle_rad, axis) *
         Eigen::Scaling(grain.radius_m);
}

}  // namespace tera
