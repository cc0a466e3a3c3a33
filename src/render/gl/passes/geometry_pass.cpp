#include "render/gl/passes/geometry_pass.h"

#include <epoxy/gl.h>

#include <cstdint>

namespace tera {
namespace {

void TestDepth() {
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GREATER);
}

}  // namespace

void GeometryPass::DrawNodes(const View& view, const NodeRenderer& nodes, const Pictures& p) const {
  glBindFramebuffer(GL_FRAMEBUFFER, p.geometry_target.id());
  glViewport(0, 0, view.width_px, view.height_px);
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  const float blank[4] = {0, 0, 0, 0};
  const std::uint32_t sky[4] = {0, 0, 0, 0};
  glDepthMask(GL_TRUE);
  glClearBufferfv(GL_COLOR, 0, blank);
  glClearBufferfv(GL_COLOR, 1, blank);
  glClearBufferuiv(GL_COLOR, 2, sky);
  glClearBufferfv(GL_DEPTH, 0, blank);  // infinitely far
  for (const Program* program : {&plain_, &textured_}) {
    program->Set("u_clip_from_relative", view.ClipFromRelative());
  }
  TestDepth();
  nodes.DrawOpaque(plain_, textured_, view);
  glDisable(GL_DEPTH_TEST);
}

void GeometryPass::DrawGround(const View& view, const TerrainRenderer& terrain,
                              const GrainRenderer& grains) const {
  TestDepth();
  plain_.Use();
  grains.Draw();
  terrain.Draw(view);
  glDisable(GL_DEPTH_TEST);
}

}  // namespace tera
