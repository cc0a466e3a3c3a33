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

/// The light sources of an image.
struct Lights {
  const Daylight& daylight;
  const ShadowMap& sun_shadows;
  const LampLights& lamps;
  const GroundTextures* ground;  ///< holds the ground's shadow on surfaces; null without ground
};

/// Computes the radiance of the visible surfaces under sun, sky and lamps.
///
/// Model   ambient occlusion is computed at half resolution and smoothed. Then each pixel with a
///         surface is shaded once.
class ShadingPass {
 public:
  /// `has_lamps` compiles lamps into the shader.
  explicit ShadingPass(bool has_lamps);

  /// Computes the fraction of the sky that near surfaces leave visible. Sets the viewport to the
  /// full image.
  void Occlude(const View& view, const Pictures& p) const;
  /// Writes the radiance to the framebuffer `target`, which has the depth of `p`.
  void Shade(const View& view, const Lights& lights, const Pictures& p, unsigned target) const;

 private:
  Program occlusion_{"fullscreen.vert", "occlusion.frag"};
  Program blur_{"fullscreen.vert", "blur.frag"};
  Program shade_;
  FullScreen screen_;
  GlObject no_ground_;  ///< a shadow height below every surface
};

}  // namespace tera
