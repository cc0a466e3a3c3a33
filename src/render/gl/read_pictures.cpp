#include "render/gl/read_pictures.h"

#include <epoxy/gl.h>

#include <vector>

namespace tera {

Image<std::uint8_t> ReadColour(const GlObject& colour, int width_px, int height_px) {
  Image<std::uint8_t> rgb(width_px, height_px, 3);
  std::vector<std::uint8_t> rgba(static_cast<std::size_t>(width_px) * height_px * 4);
  glGetTextureImage(colour.id(), 0, GL_RGBA, GL_UNSIGNED_BYTE, static_cast<GLsizei>(rgba.size()),
                    rgba.data());
  for (std::size_t p = 0; p < rgba.size() / 4; ++p) {
    for (int k = 0; k < 3; ++k) rgb.data[p * 3 + k] = rgba[p * 4 + k];
  }
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

Image<float> ReadDepth(const GlObject& depth, unsigned format, const CameraIntrinsics& camera) {
  Image<float> z_m(camera.width_px, camera.height_px);
  glGetTextureImage(depth.id(), 0, format, GL_FLOAT,
                    static_cast<GLsizei>(z_m.data.size() * sizeof(float)), z_m.data.data());
  const auto near_m = static_cast<float>(camera.near_m), far_m = static_cast<float>(camera.far_m);
  for (float& d : z_m.data) {
    const float z = d > 0 ? near_m / d : 0.0f;
    d = z <= far_m ? z : 0.0f;
  }
  return z_m;
}

}  // namespace tera
