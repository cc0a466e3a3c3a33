#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/quantile.h"

namespace tera {

/// One-sided 95 % quantile of the standard normal distribution.
inline constexpr double kOneSided95 = 1.645;

/// Largest magnitude; 0 for no values.
double LargestMagnitude(std::span<const double> values);

/// Standard deviation from the median absolute deviation: 1.4826 median |x - median x|.
double RobustScale(const std::vector<double>& values);

/// Standard deviation of white noise from third differences, to which slow signals hardly
/// contribute. Each series is ordered by time. 0 without any third difference.
double WhiteNoise(const std::vector<std::vector<double>>& series);

/// First lag, in samples, at which the autocorrelation falls below `level`. At most a quarter of
/// the length; 1 for constant values.
std::size_t CorrelationLength(std::span<const double> values, double level = 0.2);

}  // namespace tera
