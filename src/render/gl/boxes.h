#pragma once

#include "render/gl/gl_objects.h"
#include "render/gl/passes/node_renderer.h"
#include "render/gl/view.h"

namespace tera {

/// Counts the pixels that an object alone would cover.
///
/// Model   the object's nodes are drawn without depth into a stencil that lets each pixel pass only
///         once, under an occlusion query: exact, whatever the number of surfaces behind each
///         other.
class Silhouettes {
 public:
  /// Pixels of each of `instances` alone in the view for which `nodes` was placed.
  std::vector<std::int64_t> Count(const View& view, const NodeRenderer& nodes,
                                  const std::vector<std::uint16_t>& instances);

 private:
  void Resize(int width_px, int height_px);

  Program program_{"node.vert", "mask.frag"};
  int width_px_ = 0, height_px_ = 0;
  GlObject stencil_, framebuffer_;
  std::vector<GlObject> queries_;
};

}  // namespace tera
