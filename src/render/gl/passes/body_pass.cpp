#include "render/gl/passes/body_pass.h"

#include <epoxy/gl.h>

#include <vector>

#include "render/gl/body_picture.h"

namespace tera {
namespace {

Image<std::uint16_t> ReadBodies(const GlObject& body, int width_px, int height_px) {
  Image<std::uint16_t> picture(width_px, height_px);
  // Reads 32-bit words: rows of 16-bit values would need padding at odd widths.
  std::vector<std::uint32_t> words(picture.data.size());
  glGetTextureImage(body.id(), 0, GL_RED_INTEGER, GL_UNSIGNED_INT,
                    static_cast<GLsizei>(words.size() * sizeof(std::uint32_t)), words.data());
  for (std::size_t p = 0; p < words.size(); ++p) {
    picture.data[p] = static_cast<std::uint16_t>(words[p]);
  }
  return picture;
}

void ClearBodies() {
  const std::uint32_t none[4] = {kNoBody, 0, 0, 0};
  glClearBufferuiv(GL_COLOR, 0, none);
}

}  // namespace

void BodyPass::Fit(int width_px, int height_px, unsigned depth, Target* target) {
  if (target->width_px == width_px && target->height_px == height_px && target->depth == depth) {
    return;
  }
  target->width_px = width_px;
  target->height_px = height_px;
  target->depth = depth;
  target->framebuffer = {};
  target->body = MakeTexture(GL_R16UI, width_px, height_px, Filter::kNearest, Wrap::kClamp);
  target->framebuffer = MakeFramebuffer({target->body.id()}, depth);
}

void BodyPass::Draw(const View& view, const Pictures& p, const NodeRenderer& nodes,
                    const GrainRenderer* grains) {
  Fit(p.width_px, p.height_px, p.depth.id(), &pinhole_);
  glBindFramebuffer(GL_FRAMEBUFFER, pinhole_.framebuffer.id());
  glViewport(0, 0, view.width_px, view.height_px);
  ClearBodies();
  glEnable(GL_DEPTH_TEST);
  glDepthMask(GL_FALSE);
  glDepthFunc(GL_GEQUAL);
  program_.Use();
  program_.Set("u_clip_from_relative", view.ClipFromRelative());
  if (grains != nullptr) {
    program_.Set("u_body", static_cast<int>(kSoilInFlight));
    grains->Draw();
  }
  nodes.DrawBodies(program_);
  glDepthMask(GL_TRUE);
  glDisable(GL_DEPTH_TEST);
}

Image<std::uint16_t> BodyPass::Read() const {
  return ReadBodies(pinhole_.body, pinhole_.width_px, pinhole_.height_px);
}

void BodyPass::ClearLens(int width_px, int height_px) {
  Fit(width_px, height_px, 0, &lens_);
  glBindFramebuffer(GL_FRAMEBUFFER, lens_.framebuffer.id());
  ClearBodies();
}

void BodyPass::DrawLens(const Lens& lens, int view) {
  glBindFramebuffer(GL_FRAMEBUFFER, lens_.framebuffer.id());
  glViewport(0, 0, lens_.width_px, lens_.height_px);
  lens_program_.Use();
  glBindTextureUnit(0, pinhole_.body.id());
  glBindTextureUnit(1, lens.map().id());
  lens_program_.Set("u_body", 0);
  lens_program_.Set("u_map", 1);
  lens_program_.Set("u_view", view);
  screen_.Draw();
}

Image<std::uint16_t> BodyPass::ReadLens() const {
  return ReadBodies(lens_.body, lens_.width_px, lens_.height_px);
}

}  // namespace tera
