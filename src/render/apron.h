#pragma once

#include "core/terrain_surface.h"
#include "render/gl_objects.h"

namespace tera {

/// The land around the site, so that the world does not end at its border.
///
/// Model   rings around the site that begin at the border's heights and pass into low seeded hills
///         out to kReach_m; meadow and a belt of trees by colour. A picture's backdrop: the soil
///         and the lidars know nothing of it.
class Apron {
 public:
  static constexpr double kReach_m = 1500.0;

  Apron() = default;
  explicit Apron(const TerrainSurface& terrain, const Eigen::Vector3f& soil_albedo);
  /// Takes over the border's heights.
  void Update(const TerrainSurface& terrain);
  /// Attributes: 0 position in W, 1 normal, 2 albedo (square roots).
  void Draw() const;
  int triangles() const { return index_count_ / 3; }

 private:
  struct Vertex {
    Eigen::Vector3f position_W_m;
    Eigen::Vector3f normal;
    Eigen::Vector3f albedo_root;
  };
  void Build(const TerrainSurface& terrain);

  Eigen::Vector3f soil_albedo_ = Eigen::Vector3f::Zero();
  int around_ = 0, index_count_ = 0;
  std::vector<Vertex> vertices_;
  GlObject vertex_buffer_, indices_, array_;
};

}  // namespace tera
