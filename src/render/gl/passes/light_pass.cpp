#include "render/gl/passes/light_pass.h"

#include <epoxy/gl.h>

namespace tera {
namespace {

constexpr float kDark[4] = {0, 0, 0, 0};

Image<float> ReadLight(const GlObject& light, int width_px, int height_px, double exposure) {
  Image<float> picture(width_px, height_px, 2);
  glGetTextureImage(light.id(), 0, GL_RG, GL_FLOAT,
                    static_cast<GLsizei>(picture.data.size() * sizeof(float)), picture.data.data());
  const auto lux = static_cast<float>(1 / exposure);
  for (std::size_t i = 0; i < picture.data.size(); i += 2) picture.data[i] *= lux;
  return picture;
}

}  // namespace

void LightPass::Fit(int width_px, int height_px, unsigned radiance, unsigned depth,
                    Target* target) {
  if (target->width_px == width_px && target->height_px == height_px &&
      target->radiance == radiance) {
    return;
  }
  target->width_px = width_px;
  target->height_px = height_px;
  target->radiance = radiance;
  target->framebuffer = {};
  target->light = MakeTexture(GL_RG32F, width_px, height_px, Filter::kNearest, Wrap::kClamp);
  target->framebuffer = radiance != 0 ? MakeFramebuffer({radiance, target->light.id()}, depth)
                                      : MakeFramebuffer({target->light.id()}, 0);
}

unsigned LightPass::TargetOf(const Pictures& p) {
  Fit(p.width_px, p.height_px, p.radiance.id(), p.depth.id(), &pinhole_);
  glBindFramebuffer(GL_FRAMEBUFFER, pinhole_.framebuffer.id());
  glClearBufferfv(GL_COLOR, 1, kDark);
  return pinhole_.framebuffer.id();
}

Image<float> LightPass::Read(double exposure) const {
  return ReadLight(pinhole_.light, pinhole_.width_px, pinhole_.height_px, exposure);
}

void LightPass::ClearLens(int width_px, int height_px) {
  Fit(width_px, height_px, 0, 0, &lens_);
  glBindFramebuffer(GL_FRAMEBUFFER, lens_.framebuffer.id());
  glClearBufferfv(GL_COLOR, 0, kDark);
}

void LightPass::DrawLens(const Lens& lens, int view) {
  glBindFramebuffer(GL_FRAMEBUFFER, lens_.framebuffer.id());
  glViewport(0, 0, lens_.width_px, lens_.height_px);
  lens_program_.Use();
  glBindTextureUnit(0, pinhole_.light.id());
  glBindTextureUnit(1, lens.map().id());
  lens_program_.Set("u_light", 0);
  lens_program_.Set("u_map", 1);
  lens_program_.Set("u_view", view);
  screen_.Draw();
}

Image<float> LightPass::ReadLens(double exposure) const {
  return ReadLight(lens_.light, lens_.width_px, lens_.height_px, exposure);
}

}  // namespace tera
