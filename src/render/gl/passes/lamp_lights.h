#pragma once

#include <vector>

#include "render/gl/gl_objects.h"
#include "render/gl/passes/drawn_scene.h"
#include "render/gl/passes/node_renderer.h"
#include "render/scene.h"

namespace tera {

/// Lamps on the GPU, with shadows of the nodes.
///
/// Model   one depth texture contains a perspective image of the nodes for each lamp, side by side.
///         It is redrawn only when a node has moved.
/// Omits   shadows of the ground, light that lamps scatter in fog, lamp glare.
class LampLights {
 public:
  explicit LampLights(const std::vector<Lamp>& lamps);

  /// Redraws the shadows if necessary. This may leave `nodes` placed relative to the origin of W.
  void Update(const SceneState& state, NodeRenderer* nodes);
  /// Binds the texture to `unit` and sets the uniforms of lamps.glsl.
  void Bind(unsigned unit, const Vec3& eye_W_m, double exposure, const Program& program) const;

 private:
  const std::vector<Lamp>& lamps_;
  Program program_{"shadow.vert", "shadow.frag"};
  GlObject texture_, framebuffer_;
  std::vector<Pose> X_WL_;
  DrawnScene drawn_;
};

}  // namespace tera
