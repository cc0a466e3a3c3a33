#pragma once

#include <array>
#include <optional>
#include <vector>

#include "render/ground/lattice_noise.h"
#include "render/scene.h"

namespace tera {

/// Daylight: what the sky radiates into every direction, and the sun's light.
///
/// Frames  W. Radiances are luminances per colour channel (linear sRGB primaries) in cd/m2; the
///         sun's illuminance in lx on a surface facing it.
/// Model   Preetham's clear sky for the turbidity and the sun's height, thin clouds laid over it
///         (seeded noise, part of the scenery and not of the measurement), and towards the horizon
///         the airlight that the fog's visibility gives. The sun's colour is what Rayleigh and
///         aerosol extinction leave at its air mass, scaled to the illuminance asked for.
///         With a cover c of clouds, the noise's highest c of the sky are cloud, whose luminance
///         goes with height as (1 + 2 sin h) / 3 of that at the zenith (CIE's overcast sky), and is
///         such that level ground has 1 - 0.75 c^3.4 of the clear sky's illuminance; the sun is
///         seen for 1 - c of the time, of which the mean is taken.
///         A sky illuminance that is given scales the clear sky.
/// Omits   the colours of twilight (the sky's pattern and colour are those of a sun at
///         kMinSunHeight_rad), ozone, shadows of single clouds.
/// Source  Preetham, Shirley, Smits 1999, "A practical analytic model for daylight", appendix;
///         Ramamoorthi, Hanrahan 2001, "An efficient representation for irradiance environment
///         maps", eq. 13; Kasten, Young 1989 for the air mass; Kasten, Czeplak 1980, "Solar and
///         terrestrial radiation dependent on the amount and type of cloud"; Moon, Spencer 1942 for
///         the overcast sky.
class Sky {
 public:
  static constexpr int kWidth = 1024, kHeight = 256;

  explicit Sky(const Environment& environment);

  Eigen::Vector3f Radiance(const Vec3& direction_W) const;
  const Eigen::Vector3f& sun_illuminance_lx() const { return sun_lx_; }
  const Vec3& to_sun_W() const { return to_sun_W_; }

  /// Texels (r, g, b) in cd/m2: column u over azimuth [0, 2 pi) from +x, row v over
  /// sqrt(sin(height)) from the horizon up, clouds included.
  const std::vector<Eigen::Vector3f>& texels() const { return texels_; }
  /// Irradiance / pi of a surface with normal n, ground bounce included: the nine coefficients of
  /// the polynomial (1, y, z, x, xy, yz, 3z2-1, xz, x2-y2).
  const std::array<Eigen::Vector3f, 9>& diffuse() const { return diffuse_; }
  /// Radiance of the fog in a horizontal direction h: a + b (h . s) + c (h . s)^2, s the sun's.
  const std::array<Eigen::Vector3f, 3>& airlight() const { return airlight_; }
  /// Mean of the sky near the zenith and of sunlit ground, for reflections.
  const Eigen::Vector3f& zenith() const { return zenith_; }
  const Eigen::Vector3f& ground() const { return ground_; }

 private:
  Eigen::Vector3f ClearSky(const Vec3& direction_W) const;
  void SetIlluminance(double level_lx);
  void FitClouds(double cover);
  float CloudNoise(const Vec3& direction_W) const;
  /// Share of a direction's light that is a cloud's, and that cloud's radiance.
  float CloudShare(const Vec3& direction_W) const;
  Eigen::Vector3f CloudRadiance(const Vec3& direction_W) const;
  Eigen::Vector3f ThinClouds(const Vec3& direction_W) const;
  /// The sky with its clouds, without haze.
  Eigen::Vector3f CloudySky(const Vec3& direction_W) const;
  Eigen::Vector3f Airlight(const Vec3& direction_W) const;
  void FitAirlight();
  void Paint(double fog_visibility_m);
  void ProjectDiffuse();

  Vec3 to_sun_W_;
  double turbidity_;
  float sky_scale_ = 1;                ///< of the clear sky
  std::optional<double> cloud_cover_;  ///< of Environment
  float cloud_threshold_ = 0;          ///< of the noise
  float cloud_zenith_cdpm2_ = 0;       ///< luminance of a cloud at the zenith
  float snow_share_;                   ///< of the ground around
  LatticeNoise cloud_noise_;
  Eigen::Vector3f sun_lx_, zenith_, ground_;
  std::vector<Eigen::Vector3f> texels_;
  std::array<Eigen::Vector3f, 9> diffuse_;
  std::array<Eigen::Vector3f, 3> airlight_;
};

}  // namespace tera
