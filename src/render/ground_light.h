#pragma once

#include <array>
#include <vector>

#include "core/terrain_surface.h"

namespace tera {

/// How far around a vertex ground shades the sky from it.
inline constexpr double kOcclusionReach_m = 1.0;

/// The share of the sky's light that reaches a vertex past the ground around it, in [0, 1].
///
/// Model   mean over eight directions of cos2 of the horizon's height, the horizon being the
///         steepest of a few samples out to kOcclusionReach_m.
/// Source  Max 1988, "Horizon mapping"; cosine-weighted sky factor of level ground.
class SkyView {
 public:
  SkyView() = default;
  /// For grids of cells of this size.
  explicit SkyView(double cell_m);
  float Factor(const TerrainSurface& terrain, int i, int j) const;

 private:
  struct Sample {
    int di = 0, dj = 0;
    float distance_m = 1;
  };
  std::array<std::array<Sample, 5>, 8> directions_;
};

/// Height of the shadow that the ground casts over each vertex: a point below it does not see the
/// sun. -infinity is not used: where nothing shades, the value lies below the ground.
///
/// Model   along the way to the sun, S(p) = max(h(q), S(q)) - |pq| tan(e), with q the next point
///         of the grid's lines towards the sun, between two vertices by linear interpolation.
std::vector<float> ShadowHeights(const TerrainSurface& terrain, const Vec3& to_sun_W);

}  // namespace tera
