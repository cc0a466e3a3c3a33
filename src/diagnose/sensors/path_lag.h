#pragma once

#include <complex>
#include <optional>
#include <vector>

namespace tera {

/// Positions x + i y in the plane at even time steps, with linear interpolation.
struct PlanarPath {
  double from_s = 0, step_s = 0.05;
  std::vector<std::complex<double>> at_m;

  bool Covers(double t_s) const;
  std::complex<double> At(double t_s) const;  ///< requires Covers(t_s)
};

struct PlanarFix {
  double t_s = 0;
  std::complex<double> at_m;
};

/// The lag of fixes behind a path.
struct PathLag {
  double lag_s = 0, sigma_s = 0;
  double share = 0;  ///< motion of the fixes / motion of the path
  double p = 1;      ///< p-value of the gain over all other lags
  /// RMS of the difference between steps of the fixes and of the path, without and with the lag,
  /// where both are known.
  double rms_before_m = 0, rms_after_m = 0;
};

/// The lag with which a path explains most of the fixes' motion. Empty if path and fixes overlap
/// too little.
///
/// Model   fixes, and the path at the fixes' times minus the lag, are averaged over a second. z is
///         the step of the fixes' mean from one second to the next, and q that of the path: z =
///         share exp(i turn) q + noise. The share is constant over the recording. The turn is
///         constant over five seconds, because headings from running gear drift and have an unknown
///         start. The lag within one minute that explains most of |z|^2 is taken.
///
///         It is tested against other lags by the gain in log-likelihood over at most 24 parts of
///         the recording (GainP). Lags up to `near_s` are compared on seconds that the path covers
///         with both lags. Lags at least one second and four standard deviations away are compared
///         on all seconds; a lag explains nothing where the path does not cover it. p is the
///         largest of these p-values, times the number of tried lags in seconds.
///
///         The noise variance is that of the residual at the found lag. Within five seconds it is
///         at least the smaller residual variance of the two compared lags. It counts twice:
///         differences of white noise have at most twice its power. The standard deviation of the
///         lag follows from the scatter of the blocks' scores.
/// Omits   errors of the path that last longer than a part of the recording.
/// Source  Shafer 2021, "Testing by betting"; Ibragimov and Mueller 2010 (steady_gain.h); White
///         1982, "Maximum likelihood estimation of misspecified models".
std::optional<PathLag> LagBehind(const PlanarPath& path, const std::vector<PlanarFix>& fixes,
                                 double near_s);

}  // namespace tera
