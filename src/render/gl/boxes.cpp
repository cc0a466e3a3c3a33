#include "render/gl/boxes.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <utility>

namespace tera {
namespace {

// Stencil bits: a mark of the last instance that covers the pixel, and a flag for parts of a whole.
constexpr unsigned kMarks = 0x7f, kKept = 0x80;
constexpr std::size_t kMostMemories = 16;  ///< cached views, enough for the cameras of a rig

bool AreSame(const std::vector<Pose>& a, const std::vector<Pose>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const Pose& p, const Pose& q) { return p.matrix() == q.matrix(); });
}

}  // namespace

Silhouettes::Silhouettes(const SceneModel& model) : objects_(model.instances.size()) {
  for (std::size_t i = 0; i < objects_.size(); ++i) {
    queries_.push_back(MakeQuery());
    const std::uint16_t whole = model.instances[i].parent;
    objects_[i].whole = whole;
    if (whole != 0) objects_[whole].parts.push_back(static_cast<std::uint16_t>(i));
  }
  for (const SceneNode& node : model.nodes) {
    for (const std::uint16_t i : {node.instance, objects_[node.instance].whole}) {
      objects_[i].bodies.push_back(node.body);
      objects_[i].changes_shape = objects_[i].changes_shape || node.shape >= 0;
    }
  }
  for (Object& object : objects_) {
    std::sort(object.bodies.begin(), object.bodies.end());
    object.bodies.erase(std::unique(object.bodies.begin(), object.bodies.end()),
                        object.bodies.end());
  }
}

void Silhouettes::Resize(int width_px, int height_px) {
  if (width_px == width_px_ && height_px == height_px_) return;
  width_px_ = width_px;
  height_px_ = height_px;
  stencil_ = MakeTexture(GL_DEPTH24_STENCIL8, width_px, height_px, Filter::kNearest, Wrap::kClamp);
  framebuffer_ = MakeFramebuffer({}, stencil_.id(), true);
}

Silhouettes::Memory& Silhouettes::MemoryOf(const View& view) {
  const auto found = std::find_if(memories_.begin(), memories_.end(),
                                  [&](const Memory& m) { return m.view.IsSame(view); });
  if (found != memories_.end()) {
    std::rotate(found, found + 1, memories_.end());
    return memories_.back();
  }
  if (memories_.size() == kMostMemories) memories_.erase(memories_.begin());
  return memories_.emplace_back(Memory{view, std::vector<std::int64_t>(objects_.size(), 0),
                                       std::vector<std::vector<Pose>>(objects_.size())});
}

std::vector<Pose> Silhouettes::PosesOf(const Object& object, const SceneState& state) const {
  std::vector<Pose> X_WB;
  if (object.changes_shape) return X_WB;
  for (const int body : object.bodies) X_WB.push_back(state.X_WB[static_cast<std::size_t>(body)]);
  return X_WB;
}

void Silhouettes::Begin(const View& view) {
  Resize(view.width_px, view.height_px);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
  glViewport(0, 0, view.width_px, view.height_px);
  glDisable(GL_DEPTH_TEST);
  glEnable(GL_STENCIL_TEST);
  const GLint blank = 0;
  glClearBufferiv(GL_STENCIL, 0, &blank);
  mark_ = 0;
  program_.Set("u_clip_from_relative", view.ClipFromRelative());
}

/// Draws an instance and counts its pixels. Sets `kept_bit` on them.
void Silhouettes::CountAlone(const View& view, const NodeRenderer& nodes, std::uint16_t instance,
                             unsigned kept_bit) {
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
  glBeginQuery(GL_SAMPLES_PASSED, queries_[instance].id());
  nodes.DrawInstance(instance, view);
  glEndQuery(GL_SAMPLES_PASSED);
}

/// Counts the pixels with the kept bit and clears that bit.
void Silhouettes::CountKept(std::uint16_t whole) {
  everywhere_.Use();
  glBindVertexArray(no_vertices_.id());
  glStencilOp(GL_KEEP, GL_KEEP, GL_ZERO);
  glStencilFunc(GL_EQUAL, kKept, kKept);
  glBeginQuery(GL_SAMPLES_PASSED, queries_[whole].id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glEndQuery(GL_SAMPLES_PASSED);
}

void Silhouettes::Draw(const View& view, const NodeRenderer& nodes, std::uint16_t object) {
  if (objects_[object].parts.empty()) return CountAlone(view, nodes, object, 0);
  for (const std::uint16_t part : objects_[object].parts) CountAlone(view, nodes, part, kKept);
  CountKept(object);
}

std::vector<std::int64_t> Silhouettes::Count(const View& view, const SceneState& state,
                                             const NodeRenderer& nodes,
                                             const std::vector<std::uint16_t>& instances) {
  Memory& memory = MemoryOf(view);
  std::vector<std::uint16_t> drawn;
  Begin(view);
  for (const std::uint16_t instance : instances) {
    const std::uint16_t whole = objects_[instance].whole;
    const std::uint16_t object = whole != 0 ? whole : instance;
    if (std::find(drawn.begin(), drawn.end(), object) != drawn.end()) continue;
    std::vector<Pose> now = PosesOf(objects_[object], state);
    if (!now.empty() && AreSame(now, memory.X_WB[object])) continue;
    memory.X_WB[object] = std::move(now);
    Draw(view, nodes, object);
    drawn.push_back(object);
  }
  glDisable(GL_STENCIL_TEST);
  const auto read = [&](std::uint16_t instance) {
    GLint64 count = 0;
    glGetQueryObjecti64v(queries_[instance].id(), GL_QUERY_RESULT, &count);
    memory.counts[instance] = count;
  };
  for (const std::uint16_t object : drawn) {
    read(object);
    for (const std::uint16_t part : objects_[object].parts) read(part);
  }
  std::vector<std::int64_t> counts;
  for (const std::uint16_t instance : instances) counts.push_back(memory.counts[instance]);
  return counts;
}

}  // namespace tera
