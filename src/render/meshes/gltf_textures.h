#pragma once

#include <tiny_gltf.h>

#include <filesystem>
#include <optional>
#include <string>

#include "render/meshes/mesh.h"

namespace tera {

/// Keeps an image's bytes as they are, to be decoded where a material uses it: an image loader for
/// tinygltf.
bool KeepImageBytes(tinygltf::Image* image, int index, std::string* error, std::string* warning,
                    int width, int height, const unsigned char* bytes, int size, void*);

/// The textures of a material; those of `known` are taken from there, others put there.
///
/// Model   PNG and JPEG, 8 bits a channel, by stb_image.
/// Throws  InputError naming file, picture and material, where a picture is missing, cannot be
///         decoded or lies on the mesh in a way that is not drawn: another set of coordinates for
///         each texture, KHR_texture_transform, formats of extensions.
MaterialTextures ReadTextures(const std::filesystem::path& file, const tinygltf::Model& model,
                              const tinygltf::Material& material, Textures* known);

/// The set of coordinates of a material's textures, which is one; nothing where it has none.
std::optional<int> UvSetOf(const std::filesystem::path& file, const tinygltf::Material& material);

}  // namespace tera
