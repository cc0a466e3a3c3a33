#include "render/gl/pictures.h"

#include <epoxy/gl.h>

namespace tera {
namespace {

unsigned ColourFormat(bool linear) { return linear ? GL_RGBA16F : GL_RGBA8; }

}  // namespace

Pictures::Pictures(int width, int height, bool linear_colour)
    : width_px(width), height_px(height), linear(linear_colour) {
  const auto texture = [&](unsigned format, Filter filter) {
    return MakeTexture(format, width, height, filter, Wrap::kClamp);
  };
  const auto half = [&] {
    return MakeTexture(GL_R8, (width + 1) / 2, (height + 1) / 2, Filter::kLinear, Wrap::kClamp);
  };
  albedo = texture(GL_RGBA8, Filter::kNearest);
  normal = texture(GL_RGBA16, Filter::kNearest);
  label = texture(GL_R32UI, Filter::kNearest);
  depth = texture(GL_DEPTH_COMPONENT32F, Filter::kNearest);
  open = half();
  open_blurred = half();
  radiance = texture(GL_RGBA16F, Filter::kNearest);
  toned = texture(ColourFormat(linear), Filter::kLinear);
  colour = texture(ColourFormat(linear), Filter::kLinear);
  geometry_target = MakeFramebuffer({albedo.id(), normal.id(), label.id()}, depth.id());
  open_target = MakeFramebuffer({open.id()}, 0);
  open_blurred_target = MakeFramebuffer({open_blurred.id()}, 0);
  sky_target = MakeFramebuffer({radiance.id()}, depth.id());
  glass_label_target = MakeFramebuffer({label.id(), normal.id()}, depth.id());
  tone_target = MakeFramebuffer({toned.id()}, 0);
  colour_target = MakeFramebuffer({colour.id()}, 0);
}

LensPictures::LensPictures(int width, int height, bool linear_colour)
    : width_px(width), height_px(height), linear(linear_colour) {
  const auto texture = [&](unsigned format) {
    return MakeTexture(format, width, height, Filter::kNearest, Wrap::kClamp);
  };
  colour = texture(ColourFormat(linear));
  label = texture(GL_R32UI);
  depth = texture(GL_R32F);
  normal = texture(GL_RGBA16);
  target = MakeFramebuffer({colour.id(), label.id(), depth.id(), normal.id()}, 0);
  target_without_normals = MakeFramebuffer({colour.id(), label.id(), depth.id()}, 0);
}

}  // namespace tera
