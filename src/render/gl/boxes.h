#pragma once

#include "core/types/measurement.h"
#include "render/gl/gl_objects.h"
#include "render/gl/passes/node_renderer.h"
#include "render/gl/view.h"
#include "render/scene.h"

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

/// Pixels of each instance in an image, those of a whole being those of its parts.
std::vector<std::int64_t> CountPixels(const Image<std::uint16_t>& instance,
                                      const SceneModel& model);

/// Boxes around the visible pixels of each visible instance, in order of instance, with their 3D
/// boxes; `visibility` is left 0. A whole is visible where a part of it is; its 3D box holds all
/// its parts as they stand, along the axes of its body.
std::vector<ObjectBox> FindBoxes(const SceneModel& model, const SceneState& state, const Pose& X_WC,
                                 const Image<std::uint16_t>& instance);

}  // namespace tera
