#pragma once

#include <cstdint>
#include <vector>

#include "render/air/dust_volume.h"
#include "render/gl/gl_objects.h"
#include "render/gl/passes/daylight.h"
#include "render/gl/passes/full_screen.h"
#include "render/gl/pictures.h"
#include "render/gl/view.h"

namespace tera {

/// Draws airborne dust over an image. Dust attenuates the background and scatters light of sun and
/// sky.
///
/// Model   radiance L' = L exp(-tau) + integral of S exp(-tau') d tau' along the ray to the visible
///         surface. Ray marching with steps of MarchStep_m runs at half resolution; a depth-aware
///         blend upsamples the result.
///         S = w (E p(theta) exp(-t) + m + E / (4 pi) (1 - exp(-t)) exp(-b t)).
///         w: single-scattering albedo. E: illuminance by the sun. p: Henyey-Greenstein phase
///         function. t: optical depth of dust towards the sun. m: mean radiance of sky and ground.
///         The last term approximates multiple scattering; b = kDiffuseLoss is this project's
///         estimate.
/// Omits   shadows of ground and machines on dust, lamp light in dust, fog in front of it, the
///         eddies' part in t.
/// Source  Henyey and Greenstein 1941; single scattering: Max 1995, "Optical models for direct
///         volume rendering", eq. 15.
class DustPass {
 public:
  static constexpr double kDiffuseLoss = 0.3;

  DustPass();
  /// Draws the dust over the radiance of `p`. Does nothing if `view` shows no dust.
  void Draw(const View& view, const DustVolume& dust, const Daylight& daylight, const Pictures& p);

 private:
  struct HalfPicture {
    int width_px, height_px;
    GlObject light;  ///< radiance and transmittance of the dust
    GlObject target;
  };
  void Send(const DustVolume& dust, const Vec3& to_sun_W);
  const HalfPicture& HalfOf(const Pictures& p);

  Program march_{"fullscreen.vert", "dust.frag"};
  Program blend_{"fullscreen.vert", "dust_blend.frag"};
  FullScreen screen_;
  GlObject cells_, base_, eddies_;
  int nx_ = 0, ny_ = 0, nz_ = 0;
  std::uint64_t version_ = 0;
  std::vector<float> texels_;
  std::vector<HalfPicture> halves_;
};

}  // namespace tera
