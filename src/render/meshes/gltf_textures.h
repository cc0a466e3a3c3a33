#pragma once

#include <tiny_gltf.h>

#include <filesystem>
#include <optional>
#include <string>

#include "render/meshes/mesh.h"

namespace tera {

/// Image loader for tinygltf that keeps the encoded bytes. ReadTextures decodes them when a
/// material uses them.
bool KeepImageBytes(tinygltf::Image* image, int index, std::string* error, std::string* warning,
                    int width, int height, const unsigned char* bytes, int size, void*);

/// Reads the textures of a material. Takes them from `known` if they are there; adds new ones to
/// it.
///
/// Model   PNG and JPEG, 8 bits per channel, by stb_image.
/// Throws  InputError with file, image and material if an image is absent or cannot be decoded.
///         Also for unsupported mappings: several texture coordinate sets in one material,
///         KHR_texture_transform, extension formats.
MaterialTextures ReadTextures(const std::filesystem::path& file, const tinygltf::Model& model,
                              const tinygltf::Material& material, Textures* known);

/// Index of the texture coordinate set of a material; empty without textures.
std::optional<int> UvSetOf(const std::filesystem::path& file, const tinygltf::Material& material);

}  // namespace tera
