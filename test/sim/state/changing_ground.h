#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <random>
#include <vector>

#include "core/types/terrain_surface.h"

/// Changing grounds, for tests of their copies.

namespace tera {

/// A grid with incomplete tiles at the border, and ground that is known only in parts.
inline TerrainSurface UnevenGround(int nx = 118, int ny = 163, int base_cells = 10) {
  const TerrainGrid grid{.origin_W_m = Vec2(-3, 2), .cell_m = 0.05, .nx = nx, .ny = ny};
  std::vector<float> heights;
  for (int b = 0; b < BaseVertexCount(ny, base_cells); ++b) {
    for (int a = 0; a < BaseVertexCount(nx, base_cells); ++a) {
      heights.push_back(std::sin(0.7f * static_cast<float>(a) + 0.3f * static_cast<float>(b)));
    }
  }
  std::vector<TerrainSurface::Cover> covers(static_cast<std::size_t>(grid.tile_count()));
  for (std::size_t t = 0; t < covers.size(); ++t) covers[t].soil = static_cast<std::uint8_t>(t % 3);
  return TerrainSurface(grid, base_cells, heights, covers);
}

inline TerrainSurface::Grain GrainAt(int number, const Vec3& p_W_m, float radius_m = 0.02f) {
  TerrainSurface::Grain grain;
  grain.p_W_m = p_W_m.cast<float>();
  grain.radius_m = radius_m;
  grain.number = static_cast<std::uint16_t>(number);
  grain.soil = static_cast<std::uint8_t>(number % 5);
  grain.moisture = static_cast<std::uint8_t>(number % 251);
  return grain;
}

inline bool SameBits(float a, float b) {
  return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}

inline bool SameGrain(const TerrainSurface::Grain& a, const TerrainSurface::Grain& b) {
  return SameBits(a.p_W_m.x(), b.p_W_m.x()) && SameBits(a.p_W_m.y(), b.p_W_m.y()) &&
         SameBits(a.p_W_m.z(), b.p_W_m.z()) && SameBits(a.radius_m, b.radius_m) &&
         a.number == b.number && a.soil == b.soil && a.moisture == b.moisture;
}

/// The first difference of two grounds, in words; empty if they are bitwise equal.
inline std::string Difference(const TerrainSurface& a, const TerrainSurface& b) {
  const TerrainGrid &grid_a = a, &grid_b = b;
  if (!(grid_a == grid_b)) return "grid";
  for (int t = 0; t < a.tile_count(); ++t) {
    const int x = t % a.tiles_x(), y = t / a.tiles_x();
    if (a.IsRefined(x, y) != b.IsRefined(x, y)) return "tile " + std::to_string(t);
  }
  for (int j = 0; j < a.ny; ++j) {
    for (int i = 0; i < a.nx; ++i) {
      const TerrainSurface::Vertex u = a.at(i, j), v = b.at(i, j);
      if (!SameBits(u.height_m, v.height_m) || !(u.cover == v.cover)) {
        return "vertex " + std::to_string(i) + ", " + std::to_string(j);
      }
    }
  }
  if (a.grains().size() != b.grains().size()) return "number of grains";
  for (std::size_t g = 0; g < a.grains().size(); ++g) {
    if (!SameGrain(a.grains()[g], b.grains()[g])) return "grain " + std::to_string(g);
  }
  return "";
}

/// Applies every kind of change to a ground, step by step.
class GroundAtWork {
 public:
  explicit GroundAtWork(std::uint32_t seed) : random_(seed) {}

  void Step(TerrainSurface* ground) {
    ++step_;
    if (step_ % 7 != 0) Work(ground);  // now and then nothing moves
    if (step_ % 11 == 0) ground->Refine(Below(ground->tiles_x()), Below(ground->tiles_y()));
    if (step_ % 5 == 0) Set(ground, ground->nx - 1, ground->ny - 1);
    if (step_ % 5 == 1) Set(ground, 0, 0);
    if (step_ % 9 == 0) {  // the borders between tiles
      Set(ground, std::min(TerrainGrid::kTileCells, ground->nx - 1), Below(ground->ny));
      Set(ground, Below(ground->nx), std::min(TerrainGrid::kTileCells, ground->ny - 1));
    }
    Fly(ground);
  }

 private:
  int Below(int n) { return static_cast<int>(random_() % static_cast<std::uint32_t>(n)); }

  void Set(TerrainSurface* ground, int i, int j) {
    TerrainSurface::Vertex vertex = ground->at(i, j);
    if (Below(3) != 0) vertex.height_m += 1e-3f * static_cast<float>(Below(100) - 50);
    if (Below(20) == 0) vertex.height_m = -vertex.height_m;
    if (Below(3) == 0) vertex.cover.looseness = static_cast<std::uint8_t>(random_());
    if (Below(4) == 0) vertex.cover.rut = static_cast<std::uint8_t>(random_());
    if (Below(9) == 0) vertex.cover.soil = static_cast<std::uint8_t>(random_());
    if (Below(9) == 0) vertex.cover.moisture = static_cast<std::uint8_t>(random_());
    ground->Set(i, j, vertex);
  }

  void Work(TerrainSurface* ground) {
    const int i0 = Below(ground->nx), j0 = Below(ground->ny);
    for (int j = j0; j < std::min(j0 + 6, ground->ny); ++j) {
      for (int i = i0; i < std::min(i0 + 9, ground->nx); ++i) Set(ground, i, j);
    }
  }

  /// Clods appear, fly and vanish; some share a number.
  void Fly(TerrainSurface* ground) {
    std::vector<TerrainSurface::Grain> grains;
    for (TerrainSurface::Grain grain : ground->grains()) {
      grain.p_W_m +=
          Eigen::Vector3f(0.01f, -0.003f, 0.02f - 0.002f * static_cast<float>(step_ % 20));
      if (Below(15) != 0) grains.push_back(grain);
    }
    for (int n = step_ % 40 < 20 ? Below(4) : 0; n > 0; --n) {
      grains.push_back(GrainAt(Below(30) == 0 ? 65535 : Below(60), {1e-3 * Below(5000), -0.5, 2},
                               0.01f * static_cast<float>(1 + Below(5))));
    }
    if (step_ % 10 == 0 && grains.size() > 1) std::swap(grains.front(), grains.back());
    if (step_ % 37 == 0) grains.clear();
    ground->SetGrains(grains);
  }

  std::mt19937 random_;
  int step_ = 0;
};

}  // namespace tera
