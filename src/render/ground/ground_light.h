#pragma once

#include <array>
#include <vector>

#include "core/types/terrain_surface.h"

namespace tera {

/// A rectangle of texels, without its upper ends.
struct TexelWindow {
  int i0 = 0, j0 = 0, i1 = 0, j1 = 0;
  bool empty() const { return i1 <= i0 || j1 <= j0; }
  void Extend(int i, int j);
  void Extend(const TexelWindow& other);
  /// What both hold.
  TexelWindow Within(const TexelWindow& other) const;
  /// With `texels` more on each side; nothing remains nothing.
  TexelWindow Grown(int texels) const;
};

/// Fewer windows that hold all of `windows`, and little beside: to send one costs as much as
/// `texels_of_a_window` more texels.
std::vector<TexelWindow> Gathered(const std::vector<TexelWindow>& windows, int texels_of_a_window);

/// Texels side by side, from i0 up to, not including, i1.
struct TexelRow {
  int j = 0, i0 = 0, i1 = 0;
};

/// What the windows hold, each texel in one row alone.
std::vector<TexelRow> RowsOf(const std::vector<TexelWindow>& windows);

/// Heights of a ground, one texel for every `texel_cells`-th vertex: all of them where the site is
/// small enough for a texture.
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
  /// The texel and those after it.
  const float* from(int i, int j) const { return &height_m_[index(i, j)]; }
  /// Texels of tile (a, b) and of its border.
  TexelWindow Of(int a, int b) const;
  /// Takes over the heights there; returns where they were others before.
  TexelWindow Read(const TerrainSurface& terrain, const TexelWindow& window);

 private:
  int width_ = 0, height_ = 0, texel_cells_ = 1;
  double texel_m_ = 1;
  std::vector<float> height_m_;
};

/// How far around a vertex ground shades the sky from it.
inline constexpr double kOcclusionReach_m = 1.0;

/// The share of the sky's light that reaches a texel past the ground around it, in [0, 1].
///
/// Model   mean over eight directions of cos2 of the horizon's height, the horizon being the
///         steepest of a few samples out to kOcclusionReach_m.
/// Source  Max 1988, "Horizon mapping"; cosine-weighted sky factor of level ground.
class SkyView {
 public:
  SkyView() = default;
  explicit SkyView(double texel_m);
  float Factor(const HeightTexels& heights, int i, int j) const;
  /// Those of a row, one after the other, from its first texel on.
  void Factors(const HeightTexels& heights, const TexelRow& row, float* factors) const;
  /// Heights further away than this along either axis change nothing.
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

/// Height of the shadow that the ground casts over each texel: a point below it does not see the
/// sun. Where nothing shades, the value lies below the ground.
///
/// Model   along the way to the sun, S(p) = max(h(q), S(q)) - |pq| tan(e), with q the next point
///         of the grid's lines towards the sun, between two texels by linear interpolation.
class GroundShadow {
 public:
  GroundShadow() = default;
  explicit GroundShadow(const Vec3& to_sun_W) : to_sun_W_(to_sun_W) {}

  /// Follows heights that changed within `changed`; returns where shadows changed.
  TexelWindow Update(const HeightTexels& heights, const TexelWindow& changed);
  /// Row-major as the heights.
  const std::vector<float>& shadow_m() const { return shadow_m_; }

 private:
  struct Sweep;
  Vec3 to_sun_W_ = Vec3::UnitZ();
  std::vector<float> shadow_m_;
};

}  // namespace tera
