#pragma once

#include <cstddef>

#include "diagnose/statistics/series/series.h"

namespace tera {

struct LjungBoxResult {
  double statistic = 0;
  double degrees_of_freedom = 0;
  double p = 1;
};

/// Tests whether innovations are autocorrelated.
///
/// Model   Q = (n + 2) / n sum_k n_k r_k^2 over lags 1 .. `lags`, r_k the mean product over the n_k
///         pairs that gaps leave, divided by the variance; without gaps this is Ljung and Box's
///         statistic. Q is chi-square with lags - fitted degrees of freedom; `fitted` is the order
///         of the model that whitened.
/// Source  Ljung and Box 1978, "On a measure of lack of fit in time series models".
///
/// Needs lags > fitted and more than 2 * lags valid samples. Innovations with heavy tails are
/// clipped first (series.h).
LjungBoxResult LjungBox(const Series& innovations, std::size_t lags, std::size_t fitted = 0);

}  // namespace tera
