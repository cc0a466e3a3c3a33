#include "render/gl/boxes.h"

#include <epoxy/gl.h>

#include <algorithm>

#include "core/check.h"

namespace tera {

void Silhouettes::Resize(int width_px, int height_px) {
  if (width_px == width_px_ && height_px == height_px_) return;
  width_px_ = width_px;
  height_px_ = height_px;
  stencil_ = MakeTexture(GL_DEPTH24_STENCIL8, width_px, height_px, Filter::kNearest, Wrap::kClamp);
  framebuffer_ = MakeFramebuffer({}, stencil_.id(), true);
}

std::vector<std::int64_t> Silhouettes::Count(const View& view, const NodeRenderer& nodes,
                                             const std::vector<std::uint16_t>& instances) {
  constexpr int kMarks = 255;  // values of an 8-bit stencil besides 0
  Resize(view.width_px, view.height_px);
  while (queries_.size() < instances.size()) queries_.push_back(MakeQuery());
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
  glViewport(0, 0, view.width_px, view.height_px);
  glDisable(GL_DEPTH_TEST);
  glEnable(GL_STENCIL_TEST);
  glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
  program_.Use();
  program_.Set("u_clip_from_relative", view.ClipFromRelative());
  for (std::size_t k = 0; k < instances.size(); ++k) {
    if (k % kMarks == 0) {
      const GLint blank = 0;
      glClearBufferiv(GL_STENCIL, 0, &blank);
    }
    glStencilFunc(GL_NOTEQUAL, static_cast<GLint>(k % kMarks) + 1, 0xff);
    glBeginQuery(GL_SAMPLES_PASSED, queries_[k].id());
    nodes.DrawInstance(instances[k]);
    glEndQuery(GL_SAMPLES_PASSED);
  }
  glDisable(GL_STENCIL_TEST);
  std::vector<std::int64_t> counts(instances.size());
  for (std::size_t k = 0; k < instances.size(); ++k) {
    GLint64 count = 0;
    glGetQueryObjecti64v(queries_[k].id(), GL_QUERY_RESULT, &count);
    counts[k] = count;
  }
  return counts;
}

}  // namespace tera
