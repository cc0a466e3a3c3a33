#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/quantile.h"

namespace tera {

/// The 95 % quantile of the standard normal distribution, one-sided.
inline constexpr double kOneSided95 = 1.645;

/// The largest magnitude of the values; 0 where there are none.
double LargestMagnitude(std::span<const double> values);

/// Standard deviation of a normal distribution by its median absolute deviation:
/// 1.4826 median |x - median x|.
double RobustScale(const std::vector<double>& values);

/// Standard deviation of white noise with the third differences of some series, each in the order
/// of its times: slower signals hardly count. 0 where there are none.
double WhiteNoise(const std::vector<std::vector<double>>& series);

/// First lag, in samples, at which the autocorrelation falls below `level`; at most a quarter of
/// the length. 1 for a constant.
std::size_t CorrelationLength(std::span<const double> values, double level = 0.2);

}  // namespace tera
