#pragma once

namespace tera {

/// Falling rain with a drop size distribution.
///
/// Model   N(D) = N0 exp(-L D) drops per m^3 and per metre of diameter, N0 = 8000 / (m^3 mm),
///         L = 4.1 R^-0.21 / mm with R in mm/h. The extinction cross-section is twice a drop's
///         geometric cross-section. The fall speed is 9.65 - 10.3 exp(-0.6 D / mm) m/s.
/// Omits   drops below 0.1 mm, oblate drops, gusts.
/// Source  Marshall and Palmer 1948, "The distribution of raindrops with size"; Atlas, Srivastava
///         and Sekhon 1973, Rev. Geophys. 11, eq. 8, a fit to Gunn and Kinzer 1949.
class Rain {
 public:
  explicit Rain(double rate_mmph);

  double rate_mmph() const { return rate_mmph_; }
  /// Number density of drops larger than `diameter_m`.
  double CountAbove_1pm3(double diameter_m) const;
  /// pi N0 / L^3.
  double Extinction_1pm() const;
  /// Diameter that the fraction `above` of the drops larger than `least_m` exceeds.
  double DiameterAt(double least_m, double above) const;

  static constexpr double kLargest_m = 0.006;
  static double FallSpeed_mps(double diameter_m);

 private:
  double rate_mmph_, slope_1pm_;  ///< R, L
};

}  // namespace tera
