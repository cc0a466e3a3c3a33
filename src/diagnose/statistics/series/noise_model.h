#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "diagnose/statistics/series/series.h"

namespace tera {

/// Coloured, heavy-tailed, stationary noise of one channel.
///
/// Model   x_t - mean = sum_i ar[i-1] (x_(t-i) - mean) + e_t. e_t / scale is independent Student-t
///         with `dof` degrees of freedom.
/// Omits   outliers of the measurement that do not drive the process (they bias `ar` towards zero);
///         spectral lines narrower than the order resolves; changes over time.
struct NoiseModel {
  double mean = 0;
  std::vector<double> ar;
  double scale = 1;
  double dof = 200;

  std::size_t order() const { return ar.size(); }
};

struct NoiseFitOptions {
  std::optional<std::size_t> order;  ///< empty: by BIC, up to `highest_order`
  std::size_t highest_order = 20;
  double least_dof = 0;       ///< limits the weight of the tails; the scale absorbs the rest
  bool estimate_mean = true;  ///< false: the mean is 0, and an offset stays in the innovations
};

/// Fits the model to the valid samples.
///
/// Model   conditional maximum likelihood by iteratively reweighted least squares, with weights
///         (dof + 1) / (dof + e^2 / scale^2). dof by profile likelihood. Rows that reach across a
///         gap are excluded. The order by BIC uses the rows that the highest order can use.
///         Reflection coefficients are limited to +-0.9999, so that the process is stationary.
/// Source  Lange, Little and Taylor 1989, "Robust statistical modeling using the t distribution";
///         Schwarz 1978.
///
/// Needs 16 valid samples. The order falls if segments are too short for it.
NoiseModel FitNoise(const Series& series, const NoiseFitOptions& options = {});

/// Best linear predictors of order 0 to p of an AR(p) process, and their error variances over that
/// of order p (Durbin–Levinson recursion, run backwards).
struct ShorterPredictors {
  std::vector<std::vector<double>> ar;
  std::vector<double> variance_ratio;
};
ShorterPredictors PredictorsOf(const std::vector<double>& ar);

/// Variance of a sample of the process, from its impulse response. Requires dof > 2.
double VarianceOf(const NoiseModel& noise);
/// Long-run variance: the variance of the mean of many samples, times their number. Requires dof >
/// 2.
double LongRunVarianceOf(const NoiseModel& noise);

/// Log-density of the standard Student-t distribution.
double StudentLogDensity(double x, double dof);

}  // namespace tera
