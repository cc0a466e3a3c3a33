#pragma once

#include <cstdint>
#include <vector>

#include "core/types/terrain_surface.h"
#include "render/gl/gl_objects.h"
#include "render/scene.h"

namespace tera {

/// Draws the clods of soil in the air.
class GrainRenderer {
 public:
  explicit GrainRenderer(const std::vector<SoilAppearance>& soils);

  /// Positions the clods of `terrain` relative to `eye_W_m`.
  void Place(const TerrainSurface& terrain, const Vec3& eye_W_m);
  /// Draws the clods, labelled as terrain. Needs node.vert and node.frag as the current program.
  void Draw() const;
  /// Triangles since construction.
  std::int64_t triangles_drawn() const { return triangles_drawn_; }

 private:
  struct Batch {  ///< clods of equal colour
    Eigen::Vector4f albedo_root_opacity;
    int first = 0, count = 0;
  };

  std::vector<SoilAppearance> soils_;
  std::vector<Batch> batches_;
  GlObject corners_, poses_, array_;
  std::size_t capacity_ = 0;
  mutable std::int64_t triangles_drawn_ = 0;
};

}  // namespace tera
