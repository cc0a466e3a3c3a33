#pragma once

#include "render/gl/gl_objects.h"
#include "render/scene.h"

namespace tera {

/// Draws nodes with dust, mud, scratches and rust.
///
/// Model   node.frag with wear.glsl: colour, roughness and metallic of each pixel change by where
///         it is on its body; normals, depth and labels do not.
/// Omits   thickness: mud stands on no outline. Glass stays clean.
class WornSurfaces {
 public:
  WornSurfaces();
  /// Takes this projection from now on.
  void SetView(const Eigen::Matrix4f& clip_from_relative) const;
  /// The program for a worn node, in use and told all about it; with textures or without.
  const Program& Use(const SceneNode& node, bool textured) const;

 private:
  Program plain_{"node.vert", "node.frag", {"WORN"}};
  Program textured_{"node.vert", "node.frag", {"TEXTURED", "WORN"}};
  GlObject noise_;
};

}  // namespace tera
