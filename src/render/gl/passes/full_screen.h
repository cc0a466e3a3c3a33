#pragma once

#include "render/gl/gl_objects.h"
#include "render/gl/view.h"

/// Helpers of full-screen passes.

namespace tera {

/// Draws a triangle that covers the viewport, with the vertices of fullscreen.vert.
class FullScreen {
 public:
  /// Draws with the current program and framebuffer.
  void Draw() const;

 private:
  GlObject no_vertices_ = MakeVertexArray();
};

/// Sets the uniforms that convert pixel and depth of a view to a position.
void SetView(const View& view, const Program& program);

}  // namespace tera
