#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/motion.h"

namespace tera {

/// An image mapped onto a mesh.
struct Texture {
  /// File, and position of the image in the file; equal names imply equal images.
  std::string name;
  int width_px = 0, height_px = 0;
  std::vector<std::uint8_t> rgba;  ///< rows from the top, four bytes per pixel
  enum class Wrap { kRepeat, kMirror, kClamp };
  Wrap wrap_x = Wrap::kRepeat, wrap_y = Wrap::kRepeat;
};

/// Textures by name; meshes of one file share them.
using Textures = std::map<std::string, std::shared_ptr<const Texture>>;

/// Textures of a material, as in glTF 2.0. Each is multiplied by the scalar or colour of the
/// material.
struct MaterialTextures {
  std::shared_ptr<const Texture> base_colour;         ///< sRGB
  std::shared_ptr<const Texture> metallic_roughness;  ///< green roughness, blue metallic
  std::shared_ptr<const Texture> normal;              ///< in tangent space, x right, y up
  std::shared_ptr<const Texture> occlusion;           ///< red channel: visible fraction of the sky
  std::shared_ptr<const Texture> emissive;            ///< sRGB
  double normal_scale = 1, occlusion_strength = 1;

  bool any() const { return base_colour || metallic_roughness || normal || occlusion || emissive; }
};

/// Metallic-roughness material, linear colours.
struct Material {
  Vec3 albedo = Vec3(0.5, 0.5, 0.5);
  double roughness = 0.7;
  double metallic = 0.0;
  Vec3 emission = Vec3::Zero();  ///< radiance relative to a white sheet in full sunlight
  MaterialTextures textures;
  double opacity = 1.0;             ///< below 1: glass; the rasterizer blends it
  double lidar_reflectance = -1.0;  ///< at 905 nm; negative: not stated (near_infrared.h)
};

/// Triangles of one material, in the frame of the mesh.
struct MeshPart {
  std::vector<Eigen::Vector3f> positions_m;
  std::vector<Eigen::Vector3f> normals;  ///< one per position
  std::vector<Eigen::Vector3f> albedos;  ///< one per position; empty: the material's albedo
  std::vector<Eigen::Vector2f> uvs;      ///< one per position, or empty; (0, 0) is upper left
  std::vector<std::uint32_t> indices;    ///< three per triangle
  Material material;
};

struct Mesh {
  std::string name;
  std::vector<MeshPart> parts;
  /// The mesh file and all files that it refers to.
  std::vector<std::filesystem::path> files;
};

}  // namespace tera
