#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/motion.h"

namespace tera {

/// Metallic-roughness material, linear colours.
struct Material {
  Vec3 albedo = Vec3(0.5, 0.5, 0.5);
  double roughness = 0.7;
  double metallic = 0.0;
  double opacity = 1.0;             ///< below 1: glass, seen by the rasterizer as blended
  double lidar_reflectance = -1.0;  ///< at 905 nm; negative: mean of the albedo
};

/// Triangles of one material in a body frame.
struct MeshPart {
  std::vector<Eigen::Vector3f> positions_m;
  std::vector<Eigen::Vector3f> normals;  ///< one for each position
  std::vector<Eigen::Vector3f> albedos;  ///< one for each position, or none: the material's
  std::vector<std::uint32_t> indices;    ///< three for each triangle
  Material material;
};

struct Mesh {
  std::string name;
  std::vector<MeshPart> parts;
  /// All that it was read from: its file, and those that the file names.
  std::vector<std::filesystem::path> files;
};

}  // namespace tera
