#pragma once

#include "render/gl/gl_objects.h"
#include "render/gl/passes/node_renderer.h"
#include "render/gl/view.h"
#include "render/scene.h"

namespace tera {

/// Counts the pixels that an object would cover without occluders.
///
/// Model   the object's nodes are drawn without a depth test. A stencil passes each pixel once, and
///         an occlusion query counts the passes, so overlapping surfaces do not count twice. The
///         parts of a whole also set a stencil bit; a second query counts the whole's pixels by
///         that bit, without drawing the parts again. The count of an unmoved object in an unmoved
///         view is cached.
class Silhouettes {
 public:
  explicit Silhouettes(const SceneModel& model);

  /// Unoccluded pixel count of each of `instances`. `nodes` must be placed for `view` and `state`.
  std::vector<std::int64_t> Count(const View& view, const SceneState& state,
                                  const NodeRenderer& nodes,
                                  const std::vector<std::uint16_t>& instances);

 private:
  /// Per instance: its relation to wholes and parts, and the bodies that move it.
  struct Object {
    std::uint16_t whole = 0;           ///< the whole that contains this part; 0: none
    std::vector<std::uint16_t> parts;  ///< empty unless this instance is a whole
    std::vector<int> bodies;           ///< bodies of its own nodes and of its parts' nodes
    bool changes_shape = false;
  };
  /// Cache for one view: the count of each instance, and the body poses for which it holds.
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

  std::vector<Object> objects_;  ///< one per instance
  std::vector<GlObject> queries_;
  std::vector<Memory> memories_;  ///< most recently used last
  Program program_{"node.vert", "mask.frag"};
  Program everywhere_{"fullscreen.vert", "mask.frag"};
  GlObject no_vertices_ = MakeVertexArray();
  int width_px_ = 0, height_px_ = 0;
  GlObject stencil_, framebuffer_;
  unsigned mark_ = 0;  ///< stencil mark of the last counted instance
};

}  // namespace tera
