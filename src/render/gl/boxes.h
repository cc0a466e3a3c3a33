#pragma once

#include "render/gl/gl_objects.h"
#include "render/gl/passes/node_renderer.h"
#include "render/gl/view.h"
#include "render/scene.h"

namespace tera {

/// Counts the pixels that an object would cover without occluders.
///
/// Model   an occlusion query counts the object's nodes, drawn without depth into a stencil that
///         passes each pixel once. The count is exact for any number of overlapping surfaces. The
///         parts of a whole set a stencil bit, from which the whole's pixels are counted without a
///         second draw. A static object in a static view keeps its count.
class Silhouettes {
 public:
  explicit Silhouettes(const SceneModel& model);

  /// Unoccluded pixels of each of `instances`. `nodes` must be placed for `view` as in `state`.
  std::vector<std::int64_t> Count(const View& view, const SceneState& state,
                                  const NodeRenderer& nodes,
                                  const std::vector<std::uint16_t>& instances);

 private:
  /// Unit of drawing: an instance without parts, or a whole.
  struct Object {
    std::uint16_t whole = 0;           ///< whole that contains this part; 0: none
    std::vector<std::uint16_t> parts;  ///< parts of a whole
    std::vector<int> bodies;           ///< bodies that move its nodes and its parts' nodes
    bool changes_shape = false;
  };
  /// Cache of one view: counts by instance, and the body poses of each counted object.
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
  std::vector<Memory> memories_;  ///< most recently used last
  Program program_{"node.vert", "mask.frag"};
  Program everywhere_{"fullscreen.vert", "mask.frag"};
  GlObject no_vertices_ = MakeVertexArray();
  int width_px_ = 0, height_px_ = 0;
  GlObject stencil_, framebuffer_;
  unsigned mark_ = 0;  ///< mark of the last instance in the stencil
};

}  // namespace tera
