#pragma once

#include "core/types/measurement.h"
#include "render/gl/gl_objects.h"
#include "render/gl/passes/full_screen.h"
#include "render/gl/passes/lens.h"
#include "render/gl/pictures.h"

namespace tera {

/// Writes the illuminance of the visible surface of each pixel during the shading pass.
///
/// Model   two channels: illuminance in lx by sun, sky and lamps, and the fraction of the sun that
///         arrives. Both are zero without a surface. Behind a lens, each pixel takes the nearest
///         pixel of the pinhole image, as labels do.
/// Omits   glass: the values are those of the surface behind it.
class LightPass {
 public:
  /// A cleared framebuffer for the shading of `p`. It writes the illuminance here and the radiance
  /// to its usual texture.
  unsigned TargetOf(const Pictures& p);
  /// Reads the last result, given the exposure of its image.
  Image<float> Read(double exposure) const;

  /// Clears the camera's image behind a lens.
  void ClearLens(int width_px, int height_px);
  /// Transfers the last result into the camera's image; `view` is its index in Lens::views.
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
