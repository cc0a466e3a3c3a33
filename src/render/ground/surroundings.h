#pragma once

#include <cstdint>
#include <vector>

#include "core/types/terrain_surface.h"
#include "render/scene.h"

namespace tera {

/// The land around the site, as one mesh for images and rays.
///
/// Frames  W.
/// Model   rings of vertices around the site. They start at the heights of the site's border and
///         blend into low seeded hills out to kReach_m. A belt of trees is a ridge of the mesh.
///         Meadow and forest are colours only.
/// Omits   soil: nothing digs or drives there.
class Surroundings {
 public:
  static constexpr double kReach_m = 1500.0;

  struct Vertex {
    Eigen::Vector3f position_W_m = Eigen::Vector3f::Zero();
    Eigen::Vector3f normal = Eigen::Vector3f::UnitZ();
    Eigen::Vector3f albedo_root = Eigen::Vector3f::Zero();  ///< square roots of the albedo
    float near_infrared = 0;                                ///< reflectance at 905 nm
  };

  Surroundings() = default;
  /// The land next to the site has the colour of the first of `soils`.
  Surroundings(const TerrainSurface& terrain, const std::vector<SoilAppearance>& soils);
  /// Adjusts the inner rings to the heights of the site's border.
  void Update(const TerrainSurface& terrain);

  const std::vector<Vertex>& vertices() const { return vertices_; }
  /// Three indices per triangle; they do not change.
  const std::vector<std::uint16_t>& indices() const { return indices_; }

 private:
  void Place(const TerrainSurface& terrain);

  Eigen::Vector3f soil_albedo_ = Eigen::Vector3f::Zero();
  std::vector<Vertex> vertices_;
  std::vector<std::uint16_t> indices_;
};

}  // namespace tera
