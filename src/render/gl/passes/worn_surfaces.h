#pragma once

#include "render/gl/gl_objects.h"
#include "render/scene.h"

namespace tera {

/// Draws nodes with dust, mud, scratches and rust.
///
/// Model   node.frag with wear.glsl: colour, roughness and metallic of a pixel depend on its
///         position on the body. Normals, depth and labels do not change.
/// Omits   thickness: mud does not change outlines. Glass stays clean.
class WornSurfaces {
 public:
  WornSurfaces();
  /// Sets the projection of the next draws.
  void SetView(const Eigen::Matrix4f& clip_from_relative) const;
  /// Makes the program of a worn node current and sets its uniforms.
  const Program& Use(const SceneNode& node, bool textured) const;

 private:
  Program plain_{"node.vert", "node.frag", {"WORN"}};
  Program textured_{"node.vert", "node.frag", {"TEXTURED", "WORN"}};
  GlObject noise_;
};

}  // namespace tera
