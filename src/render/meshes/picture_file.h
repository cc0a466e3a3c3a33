#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "render/meshes/mesh.h"

namespace tera {

/// Reads an image file as a repeating texture of a mesh. Takes it from `known` if it is there; adds
/// a new one to it. The path `picture` is relative to the mesh's folder.
///
/// Model   PNG and JPEG, 8 bits per channel, by stb_image.
/// Throws  InputError with mesh, material and image if the image is absent or invalid.
std::shared_ptr<const Texture> ReadPictureFile(const std::filesystem::path& mesh,
                                               const std::string& material,
                                               const std::string& picture, Textures* known);

/// Linear value in [0, 1] of an 8-bit sRGB value (IEC 61966-2-1).
double LinearOf(std::uint8_t srgb);

/// Mean of an sRGB texture, in linear values.
Vec3 MeanAlbedo(const Texture& texture);

/// Linear colour of an sRGB texture at (u, v), interpolated bilinearly.
Vec3 AlbedoAt(const Texture& texture, double u, double v);

}  // namespace tera
