#pragma once

#include "core/types/measurement.h"
#include "render/gl/gl_objects.h"
#include "render/gl/passes/full_screen.h"
#include "render/gl/passes/lens.h"
#include "render/gl/pictures.h"

namespace tera {

/// How much light falls on what each pixel shows, taken from the shading of a picture.
///
/// Model   illuminance in lx of sun, sky and lamps, and the share of the sun that arrives; zero
///         where no surface is. Behind a lens that of the nearest pixel, as for labels.
/// Omits   glass: what lies behind it is what is lit.
class LightPass {
 public:
  /// The framebuffer for the shading of `p`, empty: radiance goes where it always does.
  unsigned TargetOf(const Pictures& p);
  /// What was drawn there last, for a picture with that exposure.
  Image<float> Read(double exposure) const;

  /// Begins a camera's own picture behind a lens.
  void ClearLens(int width_px, int height_px);
  /// Takes what was drawn last as view `view` of the lens.
  void DrawLens(const Lens& lens, int view);
  Image<float> ReadLens(double exposure) const;

 private:
  struct Target {
    int width_px = 0, height_px = 0;
    unsigned radiance = 0;  ///< texture that is attached
    GlObject light, framebuffer;
  };
  static void Fit(int width_px, int height_px, unsigned radiance, unsigned depth, Target* target);

  Program lens_program_{"fullscreen.vert", "distort_light.frag"};
  FullScreen screen_;
  Target pinhole_, lens_;
};

}  // namespace tera
