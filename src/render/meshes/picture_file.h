#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "render/meshes/mesh.h"

namespace tera {

/// A picture that stands beside a mesh, as a texture that repeats; one of `known` is taken from
/// there, another put there.
///
/// Model   PNG and JPEG, 8 bits a channel, by stb_image. `picture` is relative to the mesh's
/// folder. Throws  InputError naming mesh, material and picture, where it is missing or no such
/// picture.
std::shared_ptr<const Texture> ReadPictureFile(const std::filesystem::path& mesh,
                                               const std::string& material,
                                               const std::string& picture, Textures* known);

/// The linear value of an 8-bit sRGB one (IEC 61966-2-1).
double LinearOf(std::uint8_t srgb);

/// Mean of a texture that holds sRGB, linear.
Vec3 MeanAlbedo(const Texture& texture);

/// Linear colour of a texture that holds sRGB at (u, v), bilinear between its pixels.
Vec3 AlbedoAt(const Texture& texture, double u, double v);

}  // namespace tera
