#include "render/gl/boxes.h"

#include <epoxy/gl.h>

#include <algorithm>

#include "core/check.h"

namespace tera {
namespace {

// Of the 8 bits of a stencil: which instance drew there last, and whether a part of a whole did.
constexpr unsigned kMarks = 0x7f, kKept = 0x80;

}  // namespace

Silhouettes::Silhouettes(const SceneModel& model) : families_(model.instances.size()) {
  for (std::size_t i = 1; i < families_.size(); ++i) {
    const std::uint16_t whole = model.instances[i].parent;
    families_[i].whole = whole;
    if (whole != 0) families_[whole].parts.push_back(static_cast<std::uint16_t>(i));
  }
}

void Silhouettes::Resize(int width_px, int height_px) {
  if (width_px == width_px_ && height_px == height_px_) return;
  width_px_ = width_px;
  height_px_ = height_px;
  stencil_ = MakeTexture(GL_DEPTH24_STENCIL8, width_px, height_px, Filter::kNearest, Wrap::kClamp);
  framebuffer_ = MakeFramebuffer({}, stencil_.id(), true);
}

/// Draws an instance, counting its pixels if there is a query; leaves `kept_bit` on them.
void Silhouettes::CountAlone(const NodeRenderer& nodes, std::uint16_t instance, unsigned kept_bit,
                             const GlObject* query) {
  if (mark_ == kMarks) {
    const GLint blank = 0;
    glStencilMask(kMarks);
    glClearBufferiv(GL_STENCIL, 0, &blank);
    glStencilMask(~0u);
    mark_ = 0;
  }
  ++mark_;
  program_.Use();
  glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
  glStencilFunc(GL_NOTEQUAL, static_cast<GLint>(kept_bit | mark_), kMarks);
  if (query != nullptr) glBeginQuery(GL_SAMPLES_PASSED, query->id());
  nodes.DrawInstance(instance);
  if (query != nullptr) glEndQuery(GL_SAMPLES_PASSED);
}

/// Counts the pixels that have the bit, and takes it from them.
void Silhouettes::CountKept(const GlObject& query) {
  everywhere_.Use();
  glBindVertexArray(no_vertices_.id());
  glStencilOp(GL_KEEP, GL_KEEP, GL_ZERO);
  glStencilFunc(GL_EQUAL, kKept, kKept);
  glBeginQuery(GL_SAMPLES_PASSED, query.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glEndQuery(GL_SAMPLES_PASSED);
}

std::vector<std::int64_t> Silhouettes::Count(const View& view, const NodeRenderer& nodes,
                                             const std::vector<std::uint16_t>& instances) {
  Resize(view.width_px, view.height_px);
  while (queries_.size() < instances.size()) queries_.push_back(MakeQuery());
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
  glViewport(0, 0, view.width_px, view.height_px);
  glDisable(GL_DEPTH_TEST);
  glEnable(GL_STENCIL_TEST);
  const GLint blank = 0;
  glClearBufferiv(GL_STENCIL, 0, &blank);
  mark_ = 0;
  program_.Set("u_clip_from_relative", view.ClipFromRelative());
  const auto place = [&](std::uint16_t instance) {
    return static_cast<std::size_t>(std::find(instances.begin(), instances.end(), instance) -
                                    instances.begin());
  };
  for (std::size_t k = 0; k < instances.size(); ++k) {
    const Family& family = families_[instances[k]];
    const bool is_drawn_with_its_whole =
        family.whole != 0 && place(family.whole) < instances.size();
    if (is_drawn_with_its_whole) continue;
    if (family.parts.empty()) {
      CountAlone(nodes, instances[k], 0, &queries_[k]);
      continue;
    }
    for (const std::uint16_t part : family.parts) {
      const std::size_t p = place(part);
      CountAlone(nodes, part, kKept, p < instances.size() ? &queries_[p] : nullptr);
    }
    CountKept(queries_[k]);
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
