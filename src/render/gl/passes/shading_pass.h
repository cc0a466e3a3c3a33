#pragma once

#include "render/gl/gl_objects.h"
#include "render/gl/passes/daylight.h"
#include "render/gl/passes/full_screen.h"
#include "render/gl/passes/lamp_lights.h"
#include "render/gl/passes/shadow_map.h"
#include "render/gl/pictures.h"
#include "render/gl/view.h"
#include "render/ground/ground_textures.h"

namespace tera {

/// What lights the surfaces of a picture.
struct Lights {
  const Daylight& daylight;
  const ShadowMap& sun_shadows;
  const LampLights& lamps;
  const GroundTextures* ground;  ///< whose shadow falls on surfaces too; null: there is none
};

/// Shades what each pixel shows: its radiance under sun, sky and lamps.
///
/// Model   the share of the sky that near surfaces leave open is found at half the picture's size
///         and smoothed; then each pixel where something was drawn is lit once.
class ShadingPass {
 public:
  /// `has_lamps` compiles what lamps need.
  explicit ShadingPass(bool has_lamps);

  /// What near surfaces leave open of the sky. Leaves the viewport on the whole picture.
  void Occlude(const View& view, const Pictures& p) const;
  /// Radiance into `target`, a framebuffer over the depth of `p`.
  void Shade(const View& view, const Lights& lights, const Pictures& p, unsigned target) const;

 private:
  Program occlusion_{"fullscreen.vert", "occlusion.frag"};
  Program blur_{"fullscreen.vert", "blur.frag"};
  Program shade_;
  FullScreen screen_;
  GlObject no_ground_;  ///< a shadow that falls on nothing
};

}  // namespace tera
