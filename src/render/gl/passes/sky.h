#pragma once

#include <array>
#include <optional>
#include <vector>

#include "render/scene.h"

namespace tera {

/// Daylight: the radiance of the sky in each direction, and the light of the sun.
///
/// Frames  W. Radiances are luminances per colour channel (linear sRGB primaries) in cd/m2. The
///         sun's illuminance is in lx on a surface that faces it.
/// Model   clear sky: Preetham's model, for turbidity and sun elevation. A given sky illuminance
///         scales it.
///         Sun: Rayleigh and aerosol extinction at the sun's air mass give its colour; the given
///         illuminance scales it.
///         Without a given cloud cover, thin clouds of seeded noise lie over the clear sky as
///         scenery.
///         With a cloud cover c, the fraction c of the sky with the highest noise is cloud. Its
///         luminance at elevation h is (1 + 2 sin h) / 3 of that at the zenith (CIE overcast sky).
///         The level is such that level ground has 1 - 0.75 c^3.4 of the clear sky's illuminance.
///         The sun's light is multiplied by 1 - c, its mean over time.
///         Haze: towards the horizon the sky blends into the airlight, by the visibility in fog.
/// Omits   twilight colours: below kMinSunHeight_rad the sky keeps its pattern and colour of that
///         elevation. Also ozone and shadows of single clouds.
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

  /// Radiance (r, g, b) of the sky with clouds, in cd/m2. Column: azimuth [0, 2 pi) from +x. Row:
  /// sqrt(sin(elevation)), from the horizon up.
  const std::vector<Eigen::Vector3f>& texels() const { return texels_; }
  /// Coefficients of the irradiance over pi on a surface with normal n, including light reflected
  /// from the ground. They belong to the polynomials (1, y, z, x, xy, yz, 3z2-1, xz, x2-y2) of n.
  const std::array<Eigen::Vector3f, 9>& diffuse() const { return diffuse_; }
  /// Coefficients a, b, c of the fog's radiance in the horizontal direction h: a + b (h . s) + c (h
  /// . s)^2, where s is the horizontal direction to the sun.
  const std::array<Eigen::Vector3f, 3>& airlight() const { return airlight_; }
  /// Mean radiance of the sky near the zenith, and of sunlit ground, for reflections.
  const Eigen::Vector3f& zenith() const { return zenith_; }
  const Eigen::Vector3f& ground() const { return ground_; }

 private:
  Eigen::Vector3f ClearSky(const Vec3& direction_W) const;
  void SetIlluminance(double level_lx);
  void FitClouds(double cover);
  /// Opacity of the clouds in a direction, for a given cloud cover.
  float CloudShare(const Vec3& direction_W) const;
  Eigen::Vector3f CloudRadiance(const Vec3& direction_W) const;
  Eigen::Vector3f ThinClouds(const Vec3& direction_W, float noise) const;
  /// The sky with clouds of a given cover, without haze.
  Eigen::Vector3f CloudySky(const Vec3& direction_W) const;
  Eigen::Vector3f Airlight(const Vec3& direction_W) const;
  void FitAirlight();
  void Paint(double fog_visibility_m);
  void ProjectDiffuse();

  Vec3 to_sun_W_;
  double turbidity_;
  float sky_scale_ = 1;                ///< factor on the clear sky
  std::optional<double> cloud_cover_;  ///< see Environment
  float cloud_threshold_ = 0;          ///< noise above it is cloud
  float cloud_zenith_cdpm2_ = 0;       ///< luminance of a cloud at the zenith
  float snow_share_;                   ///< snow-covered fraction of the surrounding ground
  Eigen::Vector3f sun_lx_, zenith_, ground_;
  std::vector<Eigen::Vector3f> texels_;
  std::array<Eigen::Vector3f, 9> diffuse_;
  std::array<Eigen::Vector3f, 3> airlight_;
};

}  // namespace tera
