#include "render/gl/passes/sky_and_glass.h"

#include <epoxy/gl.h>

namespace tera {

void SkyAndGlass::Draw(const View& view, const Daylight& daylight, const NodeRenderer& nodes,
                       const Pictures& p) const {
  AddOwnLight(view, daylight, nodes, p);
  DrawSky(view, daylight, p);
  DrawGlass(view, daylight, nodes, p);
}

/// Adds the emission of visible surfaces.
void SkyAndGlass::AddOwnLight(const View& view, const Daylight& daylight, const NodeRenderer& nodes,
                              const Pictures& p) const {
  if (!nodes.has_lights()) return;
  glBindFramebuffer(GL_FRAMEBUFFER, p.sky_target.id());
  glEnable(GL_DEPTH_TEST);
  glDepthMask(GL_FALSE);
  glDepthFunc(GL_GEQUAL);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE);
  own_light_.Use();
  own_light_.Set("u_clip_from_relative", view.ClipFromRelative());
  daylight.Light(own_light_);
  nodes.DrawLights(own_light_);
  glDisable(GL_BLEND);
  glDepthMask(GL_TRUE);
  glDisable(GL_DEPTH_TEST);
}

void SkyAndGlass::DrawSky(const View& view, const Daylight& daylight, const Pictures& p) const {
  glBindFramebuffer(GL_FRAMEBUFFER, p.sky_target.id());
  glEnable(GL_DEPTH_TEST);
  glDepthMask(GL_FALSE);
  glDepthFunc(GL_EQUAL);  // only pixels without a surface
  sky_.Use();
  daylight.BindSky(0, sky_);
  daylight.Light(sky_);
  SetView(view, sky_);
  screen_.Draw();
  glDepthMask(GL_TRUE);
  glDisable(GL_DEPTH_TEST);
}

void SkyAndGlass::DrawGlass(const View& view, const Daylight& daylight, const NodeRenderer& nodes,
                            const Pictures& p) const {
  if (!nodes.has_glass()) return;
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GREATER);
  glBindFramebuffer(GL_FRAMEBUFFER, p.sky_target.id());
  glDepthMask(GL_FALSE);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glass_.Use();
  glass_.Set("u_clip_from_relative", view.ClipFromRelative());
  daylight.Light(glass_);
  nodes.Draw(NodeRenderer::Surface::kGlass);
  glDisable(GL_BLEND);
  glDepthMask(GL_TRUE);
  glBindFramebuffer(GL_FRAMEBUFFER, p.glass_label_target.id());
  glass_label_.Use();
  glass_label_.Set("u_clip_from_relative", view.ClipFromRelative());
  nodes.Draw(NodeRenderer::Surface::kGlass);
  glDisable(GL_DEPTH_TEST);
}

}  // namespace tera
