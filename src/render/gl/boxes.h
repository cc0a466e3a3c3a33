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
///         drawing it again.
class Silhouettes {
 public:
  explicit Silhouettes(const SceneModel& model);

  /// Pixels of each of `instances` alone in the view for which `nodes` was placed.
  std::vector<std::int64_t> Count(const View& view, const NodeRenderer& nodes,
                                  const std::vector<std::uint16_t>& instances);

 private:
  void Resize(int width_px, int height_px);
  void CountAlone(const NodeRenderer& nodes, std::uint16_t instance, unsigned kept_bit,
                  const GlObject* query);
  void CountKept(const GlObject& query);

  struct Family {
    std::uint16_t whole = 0;  ///< or 0
    std::vector<std::uint16_t> parts;
  };
  std::vector<Family> families_;  ///< of each instance
  Program program_{"node.vert", "mask.frag"};
  Program everywhere_{"fullscreen.vert", "mask.frag"};
  GlObject no_vertices_ = MakeVertexArray();
  int width_px_ = 0, height_px_ = 0;
  GlObject stencil_, framebuffer_;
  std::vector<GlObject> queries_;
  unsigned mark_ = 0;  ///< that the last instance left in the stencil
};

}  // namespace tera
