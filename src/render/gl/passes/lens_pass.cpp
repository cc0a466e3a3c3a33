#include "render/gl/passes/lens_pass.h"

#include <epoxy/gl.h>

#include <cstdint>

namespace tera {
namespace {

unsigned TargetOf(const LensPictures& p, bool normals) {
  return (normals ? p.target : p.target_without_normals).id();
}

}  // namespace

void LensPass::Clear(const LensPictures& to, bool normals) const {
  const float dark[4] = {0, 0, 0, 0};
  const std::uint32_t nothing[4] = {0, 0, 0, 0};
  glBindFramebuffer(GL_FRAMEBUFFER, TargetOf(to, normals));
  glClearBufferfv(GL_COLOR, 0, dark);
  glClearBufferuiv(GL_COLOR, 1, nothing);
  glClearBufferfv(GL_COLOR, 2, dark);
  if (normals) glClearBufferfv(GL_COLOR, 3, dark);
}

void LensPass::Draw(const Lens& lens, int view, bool normals, const Pictures& from,
                    const LensPictures& to) const {
  glBindFramebuffer(GL_FRAMEBUFFER, TargetOf(to, normals));
  glViewport(0, 0, to.width_px, to.height_px);
  const Program& program = normals ? normals_program_ : program_;
  program.Use();
  glBindTextureUnit(0, from.colour.id());
  glBindTextureUnit(1, from.depth.id());
  glBindTextureUnit(2, from.label.id());
  glBindTextureUnit(3, lens.map().id());
  glBindTextureUnit(4, from.normal.id());
  program.Set("u_colour", 0);
  program.Set("u_depth", 1);
  program.Set("u_label", 2);
  program.Set("u_map", 3);
  program.Set("u_normal", 4);
  program.Set("u_view", view);
  screen_.Draw();
}

}  // namespace tera
