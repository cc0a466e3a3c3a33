#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace tera {

/// The value below which a share `share` of the values lies, interpolated linearly between samples.
/// There must be a value.
double Quantile(std::vector<double> values, double share);

double Median(std::vector<double> values);

/// The largest magnitude of the values; 0 where there are none.
double LargestMagnitude(std::span<const double> values);

/// Standard deviation of a normal distribution by its median absolute deviation:
/// 1.4826 median |x - median x|.
double RobustScale(const std::vector<double>& values);

/// First lag, in samples, at which the autocorrelation falls below `level`; at most a quarter of
/// the length. 1 for a constant.
std::size_t CorrelationLength(std::span<const double> values, double level = 0.2);

}  // namespace tera
