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

/// Dust over a picture: what is behind it is dimmed, and it shines in the light of sun and sky.
///
/// Model   radiance L' = L exp(-tau) + integral of S exp(-tau') d tau' along the ray up to what the
///         pixel shows, marched in steps of MarchStep_m at half the picture's size and laid over it
///         by depth. S = w (E p(theta) exp(-t) + m + E / (4 pi) (1 - exp(-t)) exp(-b t)): w what is
///         scattered, E the sun's illuminance, p Henyey and Greenstein's function, t the optical
///         depth of dust towards the sun, m the mean radiance of the sky and of the ground below
///         it; the last term stands for light that was scattered before, with b = kDiffuseLoss
///         (this project's estimate).
/// Omits   shadows of ground and machines on dust, light of lamps in it, fog before it, the eddies'
///         part in t.
/// Source  Henyey and Greenstein 1941; single scattering: Max 1995, "Optical models for direct
///         volume rendering", eq. 15.
class DustPass {
 public:
  static constexpr double kDiffuseLoss = 0.3;

  DustPass();
  /// Lays the dust over the radiance of `p`, if `view` sees any.
  void Draw(const View& view, const DustVolume& dust, const Daylight& daylight, const Pictures& p);

 private:
  struct HalfPicture {
    int width_px, height_px;
    GlObject light;  ///< radiance of the dust, and what it lets pass
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
