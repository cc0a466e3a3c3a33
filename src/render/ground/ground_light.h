#pragma once

#include <array>
#include <vector>

#include "core/types/terrain_surface.h"

namespace tera {

/// A half-open rectangle of texels.
struct TexelWindow {
  int i0 = 0, j0 = 0, i1 = 0, j1 = 0;
  bool empty() const { return i1 <= i0 || j1 <= j0; }
  void Extend(int i, int j);
  void Extend(const TexelWindow& other);
  /// Intersection of both windows.
  TexelWindow Within(const TexelWindow& other) const;
  /// Grown by `texels` on each side; an empty window stays empty.
  TexelWindow Grown(int texels) const;
};

/// Merges windows into fewer windows that cover all of `windows`. One transfer costs as much as
/// `texels_of_a_window` texels, so a merge may add up to that many texels.
std::vector<TexelWindow> Gathered(const std::vector<TexelWindow>& windows, int texels_of_a_window);

/// Adjacent texels of row j, from i0 up to but excluding i1.
struct TexelRow {
  int j = 0, i0 = 0, i1 = 0;
};

/// Texels of the windows; each texel occurs in exactly one row.
std::vector<TexelRow> RowsOf(const std::vector<TexelWindow>& windows);

/// Terrain heights, one texel per `texel_cells`-th vertex; every vertex if the site fits a texture.
class HeightTexels {
 public:
  HeightTexels() = default;
  explicit HeightTexels(const TerrainGrid& grid);

  int width() const { return width_; }
  int height() const { return height_; }
  int texel_cells() const { return texel_cells_; }
  double texel_m() const { return texel_m_; }
  std::size_t index(int i, int j) const { return static_cast<std::size_t>(j) * width_ + i; }
  float at(int i, int j) const { return height_m_[index(i, j)]; }
  float at(std::size_t k) const { return height_m_[k]; }
  /// Pointer to the texel; its successors in the row follow.
  const float* from(int i, int j) const { return &height_m_[index(i, j)]; }
  /// Texels of tile (a, b) and of its border.
  TexelWindow Of(int a, int b) const;
  /// Copies the heights of the window; returns the window of changed heights.
  TexelWindow Read(const TerrainSurface& terrain, const TexelWindow& window);

 private:
  int width_ = 0, height_ = 0, texel_cells_ = 1;
  double texel_m_ = 1;
  std::vector<float> height_m_;
};

/// Radius around a vertex within which ground occludes its sky.
inline constexpr double kOcclusionReach_m = 1.0;

/// Fraction of the sky's light that the surrounding ground leaves at a texel, in [0, 1].
///
/// Model   mean over eight directions of cos2 of the horizon's elevation. The horizon is the
///         steepest of a few samples out to kOcclusionReach_m.
/// Source  Max 1988, "Horizon mapping"; cosine-weighted sky factor of level ground.
class SkyView {
 public:
  SkyView() = default;
  explicit SkyView(double texel_m);
  float Factor(const HeightTexels& heights, int i, int j) const;
  /// Factors of a row, in order from its first texel.
  void Factors(const HeightTexels& heights, const TexelRow& row, float* factors) const;
  /// Heights beyond this distance along either axis have no effect.
  int reach_texels() const { return reach_texels_; }

 private:
  struct Sample {
    int di = 0, dj = 0;
    float distance_m = 1;
  };
  static constexpr int kAtOnce = 64;
  void InnerFactors(const HeightTexels& heights, int i, int j, int count, float* factors) const;

  std::array<std::array<Sample, 5>, 8> directions_;
  int reach_texels_ = 0;
};

/// Height of the ground's cast shadow over each texel: a point below it does not see the sun.
/// Without a shadow the value lies below the ground.
///
/// Model   S(p) = max(h(q), S(q)) - |pq| tan(e) along the direction to the sun. q is the next point
///         towards the sun on the grid's lines, linearly interpolated between two texels.
class GroundShadow {
 public:
  GroundShadow() = default;
  explicit GroundShadow(const Vec3& to_sun_W) : to_sun_W_(to_sun_W) {}

  /// Updates for heights that changed within `changed`; returns the window of changed shadows.
  TexelWindow Update(const HeightTexels& heights, const TexelWindow& changed);
  /// Row-major, like the heights.
  const std::vector<float>& shadow_m() const { return shadow_m_; }

 private:
  struct Sweep;
  Vec3 to_sun_W_ = Vec3::UnitZ();
  std::vector<float> shadow_m_;
};

}  // namespace tera
