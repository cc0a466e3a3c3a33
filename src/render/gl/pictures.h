#pragma once

#include "render/gl/gl_objects.h"

namespace tera {

/// GPU images of one size. Colour is sRGB, or linear in half floats.
struct Pictures {
  int width_px = 0, height_px = 0;
  bool linear = false;
  GlObject albedo, normal, label, depth;  ///< visible surfaces
  /// Fraction of the sky that near surfaces leave visible, at half resolution.
  GlObject open, open_blurred;
  GlObject radiance;       ///< linear, multiplied by the exposure
  GlObject toned, colour;  ///< input and output of the edge filter
  GlObject geometry_target, open_target, open_blurred_target, sky_target, glass_label_target,
      tone_target, colour_target;

  Pictures() = default;
  Pictures(int width, int height, bool linear_colour);
};

/// GPU images of the camera behind a distorting lens.
struct LensPictures {
  int width_px = 0, height_px = 0;
  bool linear = false;
  GlObject colour, label, depth, normal, target, target_without_normals;

  LensPictures() = default;
  LensPictures(int width, int height, bool linear_colour);
};

}  // namespace tera
