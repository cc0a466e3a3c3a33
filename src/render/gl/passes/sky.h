#pragma once

#include <array>
#include <vector>

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
/// Omits   sun below the horizon (its height is taken as at least kMinSunHeight_rad), ozone.
/// Source  Preetham, Shirley, Smits 1999, "A practical analytic model for daylight", appendix;
///         Ramamoorthi, Hanrahan 2001, "An efficient representation for irradiance environment
///         maps", eq. 13; Kasten, Young 1989 for the air mass.
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
  Eigen::Vector3f Airlight(const Vec3& direction_W) const;
  void FitAirlight();
  void Paint(double fog_visibility_m);
  void ProjectDiffuse();

  Vec3 to_sun_W_;
  double turbidity_;
  Eigen::Vector3f sun_lx_, zenith_, ground_;
  std::vector<Eigen::Vector3f> texels_;
  std::array<Eigen::Vector3f, 9> diffuse_;
  std::array<Eigen::Vector3f, 3> airlight_;
};

}  // namespace tera
