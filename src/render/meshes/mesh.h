#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/motion.h"

namespace tera {

/// A picture that lies on a mesh.
struct Texture {
  std::string name;  ///< file and place in it: where it is the same, so is the picture
  int width_px = 0, height_px = 0;
  std::vector<std::uint8_t> rgba;  ///< rows from the top, four bytes a pixel
  enum class Wrap { kRepeat, kMirror, kClamp };
  Wrap wrap_x = Wrap::kRepeat, wrap_y = Wrap::kRepeat;
};

/// Pictures by their names, so that meshes of one file share them.
using Textures = std::map<std::string, std::shared_ptr<const Texture>>;

/// What varies over a material, as in glTF 2.0. Where there is a texture, the material's number is
/// a factor of it.
struct MaterialTextures {
  std::shared_ptr<const Texture> base_colour;         ///< sRGB
  std::shared_ptr<const Texture> metallic_roughness;  ///< green roughness, blue metallic
  std::shared_ptr<const Texture> normal;              ///< of tangent space, x right, y up
  std::shared_ptr<const Texture> occlusion;           ///< red: share of the sky that is seen
  std::shared_ptr<const Texture> emissive;            ///< sRGB
  double normal_scale = 1, occlusion_strength = 1;

  bool any() const { return base_colour || metallic_roughness || normal || occlusion || emissive; }
};

/// Metallic-roughness material, linear colours.
struct Material {
  Vec3 albedo = Vec3(0.5, 0.5, 0.5);
  double roughness = 0.7;
  double metallic = 0.0;
  Vec3 emission = Vec3::Zero();  ///< radiance over that of a white sheet in full sun
  MaterialTextures textures;
  double opacity = 1.0;             ///< below 1: glass, seen by the rasterizer as blended
  double lidar_reflectance = -1.0;  ///< at 905 nm; negative: mean of the albedo
};

/// Triangles of one material in a body frame.
struct MeshPart {
  std::vector<Eigen::Vector3f> positions_m;
  std::vector<Eigen::Vector3f> normals;  ///< one for each position
  std::vector<Eigen::Vector3f> albedos;  ///< one for each position, or none: the material's
  std::vector<Eigen::Vector2f> uvs;      ///< one for each position, or none; (0, 0) is upper left
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
