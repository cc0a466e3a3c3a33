#pragma once

#include <cstdint>
#include <vector>

#include "core/types/terrain_surface.h"
#include "render/scene.h"

namespace tera {

/// The land around the site, which extends the world beyond its border: one mesh for images and
/// rays.
///
/// Frames  W.
/// Model   rings around the site that start at the border's heights and blend into low seeded hills
///         out to kReach_m. Meadow and a belt of trees exist as colours.
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
  /// The land near the site consists of the first of `soils`.
  Surroundings(const TerrainSurface& terrain, const std::vector<SoilAppearance>& soils);
  /// Adopts the heights of the site's border.
  void Update(const TerrainSurface& terrain);

  const std::vector<Vertex>& vertices() const { return vertices_; }
  /// Three constant indices per triangle.
  const std::vector<std::uint16_t>& indices() const { return indices_; }

 private:
  void Place(const TerrainSurface& terrain);

  Eigen::Vector3f soil_albedo_ = Eigen::Vector3f::Zero();
  std::vector<Vertex> vertices_;
  std::vector<std::uint16_t> indices_;
};

}  // namespace tera
