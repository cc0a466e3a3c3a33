#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "render/meshes/mesh.h"

namespace tera {

/// Reads an image file of a mesh as a repeating texture. A texture in `known` is reused; a new
/// texture is added to it. `picture` is relative to the mesh's folder.
///
/// Model   PNG and JPEG, 8 bits per channel, by stb_image.
/// Throws  InputError with mesh, material and image for an absent or invalid image.
std::shared_ptr<const Texture> ReadPictureFile(const std::filesystem::path& mesh,
                                               const std::string& material,
                                               const std::string& picture, Textures* known);

/// Linear value of an 8-bit sRGB value (IEC 61966-2-1).
double LinearOf(std::uint8_t srgb);

/// Linear mean of an sRGB texture.
Vec3 MeanAlbedo(const Texture& texture);

/// Linear colour of an sRGB texture at (u, v), bilinear.
Vec3 AlbedoAt(const Texture& texture, double u, double v);

}  // namespace tera
