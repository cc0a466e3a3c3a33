#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "core/types/terrain_surface.h"
#include "core/units.h"
#include "render/scene.h"

/// Small scenes for tests, made without files.

namespace tera::testing {

/// A square of 2 * half_m in the y-z plane of its own frame G, facing -x.
inline Mesh WallMesh(double half_m, double reflectance) {
  const auto h = static_cast<float>(half_m);
  MeshPart part;
  part.positions_m = {{0, -h, -h}, {0, h, -h}, {0, h, h}, {0, -h, h}};
  part.normals.assign(4, -Eigen::Vector3f::UnitX());
  part.indices = {0, 2, 1, 0, 3, 2};
  part.material.lidar_reflectance = reflectance;
  return {"wall", {part}};
}

/// A cube of 2 * half_m about the origin.
inline Mesh CubeMesh(double half_m) {
  MeshPart part;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      Vec3 n = Vec3::Zero(), u = Vec3::Zero();
      n[axis] = side;
      u[(axis + 1) % 3] = 1;
      const Vec3 v = n.cross(u);
      const auto first = static_cast<std::uint32_t>(part.positions_m.size());
      for (const auto& [a, b] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
        part.positions_m.push_back((half_m * (n + a * u + b * v)).cast<float>());
        part.normals.push_back(n.cast<float>());
      }
      for (const std::uint32_t k : {0u, 1u, 2u, 0u, 2u, 3u}) part.indices.push_back(first + k);
    }
  }
  return {"cube", {part}};
}

/// A model with the given meshes, one body and one instance for each.
inline SceneModel OneBodyEach(std::vector<Mesh> meshes) {
  SceneModel model;
  model.instances.push_back({.name = "none"});
  model.soils.emplace_back();
  model.body_count = static_cast<int>(meshes.size());
  for (int b = 0; b < model.body_count; ++b) {
    model.nodes.push_back({.mesh = b,
                           .body = b,
                           .label = SemanticClass::kStructure,
                           .instance = static_cast<std::uint16_t>(b + 1)});
    model.instances.push_back({.name = meshes[b].name + std::to_string(b),
                               .label = SemanticClass::kStructure,
                               .body = b});
  }
  model.meshes = std::move(meshes);
  return model;
}

/// nx x ny vertices, the first at (origin, origin), with heights of (x, y) in W.
inline TerrainSurface Ground(int nx, int ny, double cell_m, double origin_m,
                             const std::function<double(double, double)>& height_m) {
  TerrainSurface ground(
      TerrainGrid{.origin_W_m = Vec2(origin_m, origin_m), .cell_m = cell_m, .nx = nx, .ny = ny});
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      ground.Set(i, j, {static_cast<float>(height_m(ground.x_m(i), ground.y_m(j))), {}});
    }
  }
  return ground;
}

inline TerrainSurface NoGround() { return {}; }

}  // namespace tera::testing
