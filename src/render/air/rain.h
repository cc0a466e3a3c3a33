#pragma once

namespace tera {

/// Airborne particles with an exponential distribution of diameters.
///
/// Model   N(D) = N0 exp(-L D) particles per m^3 and per metre of diameter. The extinction
///         cross-section is twice the geometric cross-section pi/4 (s D)^2. D is the diameter of
///         the particle's water as a sphere; s >= 1 is the ratio of the particle's width to D.
class FallingParticles {
 public:
  /// Number density of particles larger than `diameter_m`.
  double CountAbove_1pm3(double diameter_m) const;
  /// pi s^2 N0 / L^3.
  double Extinction_1pm() const;
  /// Diameter that is exceeded by the fraction `above` of all particles larger than `least_m`.
  double DiameterAt(double least_m, double above) const;
  double swelling() const { return swelling_; }

  static constexpr double kLargest_m = 0.006;

 protected:
  /// Without particles if `intercept_1pm4` is 0.
  FallingParticles(double intercept_1pm4, double slope_1pm, double swelling)
      : intercept_1pm4_(intercept_1pm4), slope_1pm_(slope_1pm), swelling_(swelling) {}

 private:
  double intercept_1pm4_, slope_1pm_, swelling_;  ///< N0, L, s
};

/// Falling rain.
///
/// Model   N0 = 8000 / (m^3 mm), L = 4.1 R^-0.21 / mm with R in mm/h, s = 1. The fall speed in m/s
///         is 9.65 - 10.3 exp(-0.6 D / mm).
/// Omits   drops below 0.1 mm, oblate drops, gusts.
///         The lidar ratio excludes the glory, the back-scatter peak within 1 mrad of the backward
///         direction, because only round drops have it. The chosen ratio follows Mie theory of
///         water spheres of 0.3 to 3 mm at 905 nm, averaged over sizes: 80 to 190 sr at 5 to 20
///         mrad from the backward direction.
/// Source  Marshall and Palmer 1948, "The distribution of raindrops with size"; Atlas, Srivastava
///         and Sekhon 1973, Rev. Geophys. 11, eq. 8, a fit to Gunn and Kinzer 1949.
class Rain : public FallingParticles {
 public:
  explicit Rain(double rate_mmph);

  double rate_mmph() const { return rate_mmph_; }

  /// Ratio of extinction to back-scatter per steradian.
  static constexpr double kLidarRatio_sr = 150;
  static double FallSpeed_mps(double diameter_m);

 private:
  double rate_mmph_;
};

/// Falling snow. The diameter of a flake is that of the drop into which it melts.
///
/// Model   N0 = 3800 R^-0.87 / (m^3 mm), L = 2.55 R^-0.48 / mm, where R is the rate of melted water
///         in mm/h. s = 2.5: a flake is 2.5 times as wide as its drop. This corresponds to a
///         density of 0.065 g/cm^3, that of a flake of 3 mm.
/// Omits   wet snow, single crystals, the dependence of density on size.
/// Source  Gunn and Marshall 1958, "The distribution with size of aggregate snowflakes", J.
///         Meteorol. 15; Brandes et al. 2007, J. Appl. Meteorol. Climatol. 46, eq. 9 (density);
///         Sassen and Comstock 2001, J. Atmos. Sci. 58 (lidar ratio of ice).
class Snowfall : public FallingParticles {
 public:
  explicit Snowfall(double rate_mmph);

  static constexpr double kLidarRatio_sr = 25;
};

}  // namespace tera
