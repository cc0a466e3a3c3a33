#pragma once

#include "render/gl/gl_objects.h"
#include "render/gl/passes/node_renderer.h"
#include "render/gl/view.h"
#include "render/scene.h"

namespace tera {

/// Counts the pixels that an object alone would cover.
///
/// Model   the object's nodes are drawn without depth into a stencil that lets each pixel pass only
///         once, under an occlusion query: exact, whatever the number of surfaces behind each
///         other. The parts of a whole leave a bit behind, by which its pixels are counted without
///         drawing it again. What stands still before a camera that stands still keeps its count.
class Silhouettes {
 public:
  explicit Silhouettes(const SceneModel& model);

  /// Pixels of each of `instances` alone in the view for which `nodes` was placed as in `state`.
  std::vector<std::int64_t> Count(const View& view, const SceneState& state,
                                  const NodeRenderer& nodes,
                                  const std::vector<std::uint16_t>& instances);

 private:
  /// What is drawn at once: an instance without parts, or a whole.
  struct Object {
    std::uint16_t whole = 0;           ///< of an instance that is a part
    std::vector<std::uint16_t> parts;  ///< of a whole
    std::vector<int> bodies;           ///< that its nodes, and its parts', move with
    bool changes_shape = false;
  };
  /// Of one view: counts by instance, and of each object drawn the poses of its bodies then.
  struct Memory {
    View view;
    std::vector<std::int64_t> counts;
    std::vector<std::vector<Pose>> X_WB;
  };
  void Resize(int width_px, int height_px);
  Memory& MemoryOf(const View& view);
  std::vector<Pose> PosesOf(const Object& object, const SceneState& state) const;
  void Begin(const View& view);
  void Draw(const View& view, const NodeRenderer& nodes, std::uint16_t object);
  void CountAlone(const View& view, const NodeRenderer& nodes, std::uint16_t instance,
                  unsigned kept_bit);
  void CountKept(std::uint16_t whole);

  std::vector<Object> objects_;  ///< by instance
  std::vector<GlObject> queries_;
  std::vector<Memory> memories_;  ///< the one used last at the end
  Program program_{"node.vert", "mask.frag"};
  Program everywhere_{"fullscreen.vert", "mask.frag"};
  GlObject no_vertices_ = MakeVertexArray();
  int width_px_ = 0, height_px_ = 0;
  GlObject stencil_, framebuffer_;
  unsigned mark_ = 0;  ///< that the last instance left in the stencil
};

}  // namespace tera
