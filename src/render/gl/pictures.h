#pragma once

#include "render/gl/gl_objects.h"

namespace tera {

/// GPU images of one size, with colour in sRGB or linear half floats.
struct Pictures {
  int width_px = 0, height_px = 0;
  bool linear = false;
  GlObject albedo, normal, label, depth;  ///< visible surfaces
  GlObject open, open_blurred;            ///< visible sky fraction, at half resolution
  GlObject radiance;                      ///< linear, exposed
  GlObject toned, colour;                 ///< input and output of the edge filter
  GlObject geometry_target, open_target, open_blurred_target, sky_target, glass_label_target,
      tone_target, colour_target;

  Pictures() = default;
  Pictures(int width, int height, bool linear_colour);
};

/// The camera's image behind a distorting lens.
struct LensPictures {
  int width_px = 0, height_px = 0;
  bool linear = false;
  GlObject colour, label, depth, normal, target, target_without_normals;

  LensPictures() = default;
  LensPictures(int width, int height, bool linear_colour);
};

}  // namespace tera
