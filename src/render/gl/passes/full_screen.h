#pragma once

#include "render/gl/gl_objects.h"
#include "render/gl/view.h"

/// Common parts of full-screen passes.

namespace tera {

/// Covers all pixels of the viewport once, with the vertices of fullscreen.vert.
class FullScreen {
 public:
  /// Uses the current program and framebuffer.
  void Draw() const;

 private:
  GlObject no_vertices_ = MakeVertexArray();
};

/// Sets the uniforms that convert pixels and depths of a view to positions.
void SetView(const View& view, const Program& program);

}  // namespace tera
