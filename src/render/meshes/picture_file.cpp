#include "render/meshes/picture_file.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <utility>
#include <vector>

#include "core/error.h"

namespace tera {
namespace {

constexpr int kRgba = 4;

/// Maps a pixel index beyond the border to 0 .. n - 1, as the wrap mode defines.
int Wrapped(int i, int n, Texture::Wrap wrap) {
  if (wrap == Texture::Wrap::kClamp) return std::clamp(i, 0, n - 1);
  const int period = wrap == Texture::Wrap::kMirror ? 2 * n : n;
  const int in_period = (i % period + period) % period;
  return in_period < n ? in_period : 2 * n - 1 - in_period;
}

}  // namespace

std::shared_ptr<const Texture> ReadPictureFile(const std::filesystem::path& mesh,
                                               const std::string& material,
                                               const std::string& picture, Textures* known) {
  const std::filesystem::path file = mesh.parent_path() / picture;
  std::shared_ptr<const Texture>& entry = (*known)[file.string()];
  if (entry) return entry;
  const auto refuse = [&](const std::string& finding) {
    known->erase(file.string());
    throw InputError(mesh.string(),
                     {FaultKind::kMalformed, fmt::format("material '{}' {}", material, finding)});
  };
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) {
    refuse(
        fmt::format("needs the picture '{}', which is missing; put it beside the file", picture));
  }
  std::ifstream stream(file, std::ios::binary);
  const std::vector<unsigned char> bytes((std::istreambuf_iterator<char>(stream)),
                                         std::istreambuf_iterator<char>());
  tinygltf::Image image;
  std::string fault, warning;
  const bool ok =
      !bytes.empty() && tinygltf::LoadImageData(&image, 0, &fault, &warning, 0, 0, bytes.data(),
                                                static_cast<int>(bytes.size()), nullptr);
  if (!ok || image.image.empty() || image.bits != 8 || image.component != kRgba) {
    refuse(
        fmt::format("has '{}', {} bytes that are no picture of 8 bits a channel; need PNG or "
                    "JPEG",
                    picture, bytes.size()));
  }
  Texture texture;
  texture.name = file.string();
  texture.width_px = image.width;
  texture.height_px = image.height;
  texture.rgba = std::move(image.image);
  return entry = std::make_shared<const Texture>(std::move(texture));
}

double LinearOf(std::uint8_t srgb) {
  const double x = srgb / 255.0;
  return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
}

Vec3 MeanAlbedo(const Texture& texture) {
  std::array<double, 256> linear;
  for (int k = 0; k < 256; ++k) linear[k] = LinearOf(static_cast<std::uint8_t>(k));
  Vec3 sum = Vec3::Zero();
  for (std::size_t p = 0; p < texture.rgba.size(); p += kRgba) {
    sum += Vec3(linear[texture.rgba[p]], linear[texture.rgba[p + 1]], linear[texture.rgba[p + 2]]);
  }
  return sum * kRgba / static_cast<double>(texture.rgba.size());
}

Vec3 AlbedoAt(const Texture& texture, double u, double v) {
  const double x = u * texture.width_px - 0.5, y = v * texture.height_px - 0.5;
  const double i = std::floor(x), j = std::floor(y);
  const auto at = [&](double a, double b) {
    const int column = Wrapped(static_cast<int>(a), texture.width_px, texture.wrap_x);
    const int row = Wrapped(static_cast<int>(b), texture.height_px, texture.wrap_y);
    const std::uint8_t* p =
        &texture.rgba[kRgba * (static_cast<std::size_t>(row) * texture.width_px + column)];
    return Vec3(LinearOf(p[0]), LinearOf(p[1]), LinearOf(p[2]));
  };
  const double s = x - i, t = y - j;
  return (1 - t) * ((1 - s) * at(i, j) + s * at(i + 1, j)) +
         t * ((1 - s) * at(i, j + 1) + s * at(i + 1, j + 1));
}

}  // namespace tera
