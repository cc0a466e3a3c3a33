#pragma once

#include <array>
#include <optional>
#include <vector>

#include "render/scene.h"

namespace tera {

/// Daylight: radiance of the sky in each direction, and sunlight.
///
/// Frames  W. Radiances are luminances per colour channel (linear sRGB primaries) in cd/m2. The
///         sun's illuminance is in lx on a surface facing it.
/// Model   Preetham's clear sky for turbidity and sun elevation. Thin clouds of seeded noise lie
///         over it, as part of the scenery. Towards the horizon, the airlight follows from the
///         fog's visibility. Rayleigh and aerosol extinction at the sun's air mass determine its
///         colour, scaled to the given illuminance. A cloud cover c turns the fraction c of the sky
///         with the highest noise into cloud. Its luminance varies with elevation h as
///         (1 + 2 sin h) / 3 of the zenith's (CIE overcast sky). Its scale gives level ground
///         1 - 0.75 c^3.4 of the clear sky's illuminance. The sun's light is scaled by 1 - c, the
///         mean over time. A given sky illuminance scales the clear sky.
/// Omits   twilight colours (below kMinSunHeight_rad the sky keeps its pattern and colour at that
///         elevation), ozone, shadows of single clouds.
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
  /// sqrt(sin(elevation)) from the horizon up, clouds included.
  const std::vector<Eigen::Vector3f>& texels() const { return texels_; }
  /// Irradiance / pi of a surface with normal n, including light reflected from the ground. The
  /// nine coefficients belong to the polynomial (1, y, z, x, xy, yz, 3z2-1, xz, x2-y2).
  const std::array<Eigen::Vector3f, 9>& diffuse() const { return diffuse_; }
  /// Radiance of the fog in a horizontal direction h: a + b (h . s) + c (h . s)^2, s the sun's
  /// direction.
  const std::array<Eigen::Vector3f, 3>& airlight() const { return airlight_; }
  /// Mean radiance of the sky near the zenith, and of sunlit ground, for reflections.
  const Eigen::Vector3f& zenith() const { return zenith_; }
  const Eigen::Vector3f& ground() const { return ground_; }

 private:
  Eigen::Vector3f ClearSky(const Vec3& direction_W) const;
  void SetIlluminance(double level_lx);
  void FitClouds(double cover);
  /// Cloud fraction in a direction, and the radiance of the cloud.
  float CloudShare(const Vec3& direction_W) const;
  Eigen::Vector3f CloudRadiance(const Vec3& direction_W) const;
  Eigen::Vector3f ThinClouds(const Vec3& direction_W, float noise) const;
  /// The sky with its clouds, without haze.
  Eigen::Vector3f CloudySky(const Vec3& direction_W) const;
  Eigen::Vector3f Airlight(const Vec3& direction_W) const;
  void FitAirlight();
  void Paint(double fog_visibility_m);
  void ProjectDiffuse();

  Vec3 to_sun_W_;
  double turbidity_;
  float sky_scale_ = 1;                ///< factor on the clear sky
  std::optional<double> cloud_cover_;  ///< see Environment
  float cloud_threshold_ = 0;          ///< noise threshold of clouds
  float cloud_zenith_cdpm2_ = 0;       ///< luminance of a cloud at the zenith
  float snow_share_;                   ///< snow-covered fraction of the surrounding ground
  Eigen::Vector3f sun_lx_, zenith_, ground_;
  std::vector<Eigen::Vector3f> texels_;
  std::array<Eigen::Vector3f, 9> diffuse_;
  std::array<Eigen::Vector3f, 3> airlight_;
};

}  // namespace tera
