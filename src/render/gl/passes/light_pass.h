#pragma once

#include "core/types/measurement.h"
#include "render/gl/gl_objects.h"
#include "render/gl/passes/full_screen.h"
#include "render/gl/passes/lens.h"
#include "render/gl/pictures.h"

namespace tera {

/// Illuminance of the visible surface of each pixel, from the shading pass.
///
/// Model   illuminance in lx of sun, sky and lamps, and the arriving fraction of the sun; zero
///         without a surface. With a lens, the nearest pixel counts, as for labels.
/// Omits   glass: the surface behind it counts.
class LightPass {
 public:
  /// Empty framebuffer for the shading of `p`; radiance has its usual target.
  unsigned TargetOf(const Pictures& p);
  /// Reads the last result, for an image with that exposure.
  Image<float> Read(double exposure) const;

  /// Clears the camera's image behind a lens.
  void ClearLens(int width_px, int height_px);
  /// Resamples the last result as view `view` of the lens.
  void DrawLens(const Lens& lens, int view);
  Image<float> ReadLens(double exposure) const;

 private:
  struct Target {
    int width_px = 0, height_px = 0;
    unsigned radiance = 0;  ///< attached texture
    GlObject light, framebuffer;
  };
  static void Fit(int width_px, int height_px, unsigned radiance, unsigned depth, Target* target);

  Program lens_program_{"fullscreen.vert", "distort_light.frag"};
  FullScreen screen_;
  Target pinhole_, lens_;
};

}  // namespace tera
