#pragma once

#include <vector>

#include "diagnose/motion/motion_problem.h"

namespace tera {

/// Residuals of one noise channel by segment, in order of time.
struct ChannelResiduals {
  std::vector<std::vector<double>> by_segment;
};

/// Degrees of freedom of Student's t for errors.
inline constexpr double kErrorDof = 5;

/// Weight of a residual in iteratively reweighted least squares under Student's t.
double ErrorWeight(double residual, double sigma);

/// Sets sigma and inflation of each channel from its residuals.
///
/// Model   mean and scale by maximum likelihood under Student's t with `kErrorDof` degrees of
///         freedom. The scale is at least that of the data sheet. The mean of the residuals counts
///         as a systematic error, not as noise. Inflation is 1 + 2 sum rho_k of weighted residuals
///         about that mean. The sum ends at the first lag with an autocorrelation below 0.05, or at
///         100 lags.
/// Omits   the part of the errors that the estimated motion absorbs.
/// Source  Lange, Little and Taylor 1989; Sokal 1989, "Monte Carlo methods in statistical
///         mechanics", on summing autocorrelations.
void EstimateNoise(const std::vector<ChannelResiduals>& residuals,
                   std::vector<NoiseChannel>* noise);

}  // namespace tera
