#pragma once

#include "render/gl/gl_objects.h"
#include "render/gl/view.h"

/// What passes over each pixel of a picture share.

namespace tera {

/// Covers all pixels of the viewport once. Its vertices are those of fullscreen.vert.
class FullScreen {
 public:
  /// With the program and the framebuffer in use.
  void Draw() const;

 private:
  GlObject no_vertices_ = MakeVertexArray();
};

/// Uniforms that turn pixels and depths of a view back into positions.
void SetView(const View& view, const Program& program);

}  // namespace tera
