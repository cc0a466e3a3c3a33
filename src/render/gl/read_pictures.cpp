#include "render/gl/read_pictures.h"

#include <epoxy/gl.h>

namespace tera {
namespace {

constexpr std::size_t kLeastPixelsOfThread = 1 << 15;  ///< minimum number of pixels per thread

}  // namespace

Image<std::uint8_t> ColourOf(std::span<const std::uint8_t> rgba, int width_px, int height_px,
                             Workers* workers) {
  Image<std::uint8_t> rgb(width_px, height_px, 3);
  workers->ForRanges(rgba.size() / 4, kLeastPixelsOfThread,
                     [&](std::size_t begin, std::size_t end) {
                       const std::uint8_t* from = &rgba[4 * begin];
                       std::uint8_t* to = &rgb.data[3 * begin];
                       for (std::size_t p = begin; p < end; ++p, from += 4, to += 3) {
                         to[0] = from[0];
                         to[1] = from[1];
                         to[2] = from[2];
                       }
                     });
  return rgb;
}

Image<float> ReadLuminance(const GlObject& colour, int width_px, int height_px,
                           double white_cdpm2) {
  Image<float> rgb(width_px, height_px, 3);
  glGetTextureImage(colour.id(), 0, GL_RGB, GL_FLOAT,
                    static_cast<GLsizei>(rgb.data.size() * sizeof(float)), rgb.data.data());
  const auto scale_cdpm2 = static_cast<float>(white_cdpm2);
  for (float& value : rgb.data) value *= scale_cdpm2;
  return rgb;
}

Image<float> DepthOf(std::span<const float> stored, const CameraIntrinsics& camera,
                     Workers* workers) {
  Image<float> z_m(camera.width_px, camera.height_px);
  const auto near_m = static_cast<float>(camera.near_m), far_m = static_cast<float>(camera.far_m);
  workers->ForRanges(stored.size(), kLeastPixelsOfThread, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p) {
      const float z = stored[p] > 0 ? near_m / stored[p] : 0.0f;
      z_m.data[p] = z <= far_m ? z : 0.0f;
    }
  });
  return z_m;
}

}  // namespace tera
