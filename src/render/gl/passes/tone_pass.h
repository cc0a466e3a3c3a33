#pragma once

#include "render/gl/gl_objects.h"
#include "render/gl/passes/full_screen.h"
#include "render/gl/pictures.h"

namespace tera {

/// Last pass: converts radiance to sRGB (or keeps a linear image linear) and smooths edges.
class TonePass {
 public:
  void Draw(const Pictures& p) const;

 private:
  Program tone_{"fullscreen.vert", "tone.frag"};
  Program linear_{"fullscreen.vert", "linear.frag"};
  Program edges_{"fullscreen.vert", "edges.frag"};
  FullScreen screen_;
};

}  // namespace tera
