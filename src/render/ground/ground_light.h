#pragma once

#include <array>
#include <vector>

#include "core/types/terrain_surface.h"

namespace tera {

/// A rectangle of texels; i1 and j1 are exclusive.
struct TexelWindow {
  int i0 = 0, j0 = 0, i1 = 0, j1 = 0;
  bool empty() const { return i1 <= i0 || j1 <= j0; }
  void Extend(int i, int j);
  void Extend(const TexelWindow& other);
  TexelWindow Within(const TexelWindow& other) const;
  /// The window, enlarged by `texels` on each side. An empty window stays empty.
  TexelWindow Grown(int texels) const;
};

/// Merges windows into fewer ones that cover all of `windows`. A transfer has a fixed cost equal to
/// that of `texels_of_a_window` texels; a merge adds at most that many texels.
std::vector<TexelWindow> Gathered(const std::vector<TexelWindow>& windows, int texels_of_a_window);

/// Adjacent texels of row j; i1 is exclusive.
struct TexelRow {
  int j = 0, i0 = 0, i1 = 0;
};

/// The texels of all windows. Each texel is in exactly one row.
std::vector<TexelRow> RowsOf(const std::vector<TexelWindow>& windows);

/// Terrain heights as texels: every `texel_cells`-th vertex of the terrain. `texel_cells` is 1 if
/// the site fits a texture.
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
  /// Pointer to a texel. The later texels of its row follow.
  const float* from(int i, int j) const { return &height_m_[index(i, j)]; }
  /// Texels of terrain tile (a, b) with its border.
  TexelWindow Of(int a, int b) const;
  /// Copies the heights of the window from `terrain`. Returns the window in which heights changed.
  TexelWindow Read(const TerrainSurface& terrain, const TexelWindow& window);

 private:
  int width_ = 0, height_ = 0, texel_cells_ = 1;
  double texel_m_ = 1;
  std::vector<float> height_m_;
};

/// Radius around a texel within which ground occludes the sky.
inline constexpr double kOcclusionReach_m = 1.0;

/// Fraction of the sky's light that the surrounding ground leaves at a texel, in [0, 1].
///
/// Model   mean over eight directions of the squared cosine of the horizon's elevation. The horizon
///         of a direction is the steepest of a few samples within kOcclusionReach_m.
/// Source  Max 1988, "Horizon mapping"; cosine-weighted sky factor of level ground.
class SkyView {
 public:
  SkyView() = default;
  explicit SkyView(double texel_m);
  float Factor(const HeightTexels& heights, int i, int j) const;
  /// Factors of the texels of a row.
  void Factors(const HeightTexels& heights, const TexelRow& row, float* factors) const;
  /// Texels farther away along i or j have no influence.
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

/// Height of the shadow that the ground casts, for each texel: a point below this height is in
/// shadow. Where there is no shadow, the value is below the ground.
///
/// Model   S(p) = max(h(q), S(q)) - |pq| tan(e), where e is the elevation of the sun. q is the next
///         point from p towards the sun on a grid line; h(q) and S(q) are interpolated linearly
///         between two texels.
class GroundShadow {
 public:
  GroundShadow() = default;
  explicit GroundShadow(const Vec3& to_sun_W) : to_sun_W_(to_sun_W) {}

  /// Updates the shadow after heights changed within `changed`. Returns the window of changed
  /// shadows.
  TexelWindow Update(const HeightTexels& heights, const TexelWindow& changed);
  /// Row-major, like the heights.
  const std::vector<float>& shadow_m() const { return shadow_m_; }

 private:
  struct Sweep;
  Vec3 to_sun_W_ = Vec3::UnitZ();
  std::vector<float> shadow_m_;
};

}  // namespace tera
