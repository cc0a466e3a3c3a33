#pragma once

#include <complex>
#include <optional>
#include <vector>

namespace tera {

/// Places in the plane, x + i y, evenly spaced in time, linear between.
struct PlanarPath {
  double from_s = 0, step_s = 0.05;
  std::vector<std::complex<double>> at_m;

  bool Covers(double t_s) const;
  std::complex<double> At(double t_s) const;  ///< within the time it covers
};

/// A place in the plane at a time.
struct PlanarFix {
  double t_s = 0;
  std::complex<double> at_m;
};

/// By how much fixes come after the path that they are of.
struct PathLag {
  double lag_s = 0, sigma_s = 0;
  double share = 0;  ///< motion of the fixes over that of the path
  double p = 1;      ///< of so steady a gain over all other lags by chance
  /// RMS of the fixes' motion in a step less the path's, without a lag and with it, where both are
  /// there.
  double rms_before_m = 0, rms_after_m = 0;
};

/// The lag with which a path explains most of the fixes' steps; none where they have too little
/// time in common.
///
/// Model   fixes are averaged over a second, and the path likewise, at their times less a lag. q is
///         the step of the path's means from one second to the next, z that of the fixes', z =
///         share exp(i turn) q + noise. The share is one for the whole recording. The turn is one
///         for each five seconds, because headings by running gear drift and start unknown. The lag
///         is the one, up to a minute, that explains most of |z|^2.
///         The lag is tested against others by the gain in log-likelihood over at most two dozen
///         parts of the recording (GainP). Lags up to `near_s` have to be wrong, on those seconds
///         alone that the path covers with both lags. Lags at least a second and at least four
///         deviations away have to be worse, on all seconds. A lag explains nothing where the path
///         does not cover it. p is the largest of these, over as many tries as there are seconds of
///         lags.
///         Noise is the residual of the lag. In each five seconds the smaller residual of the two
///         lags replaces it where that is larger. Its variance counts twice, as the power of
///         differences of white noise where they are loudest. The deviation of the lag is that by
///         the scatter of the blocks' scores.
/// Omits   errors of the path that last longer than a part of the recording.
/// Source  Shafer 2021, "Testing by betting"; Ibragimov and Mueller 2010 (steady_gain.h); White
///         1982, "Maximum likelihood estimation of misspecified models".
std::optional<PathLag> LagBehind(const PlanarPath& path, const std::vector<PlanarFix>& fixes,
                                 double near_s);

}  // namespace tera
