#include "render/gl/passes/tone_pass.h"

#include <epoxy/gl.h>

namespace tera {

void TonePass::Draw(const Pictures& p) const {
  glBindFramebuffer(GL_FRAMEBUFFER, p.tone_target.id());
  const Program& program = p.linear ? linear_ : tone_;
  program.Use();
  glBindTextureUnit(0, p.radiance.id());
  program.Set("u_radiance", 0);
  screen_.Draw();
  glBindFramebuffer(GL_FRAMEBUFFER, p.colour_target.id());
  edges_.Use();
  glBindTextureUnit(0, p.toned.id());
  edges_.Set("u_colour", 0);
  screen_.Draw();
}

}  // namespace tera
