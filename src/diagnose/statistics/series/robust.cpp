#include "diagnose/statistics/series/robust.h"

#include <algorithm>
#include <cmath>

namespace tera {

double LargestMagnitude(std::span<const double> values) {
  double largest = 0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

double RobustScale(const std::vector<double>& values) {
  const double middle = Median(values);
  std::vector<double> distance(values.size());
  std::transform(values.begin(), values.end(), distance.begin(),
                 [middle](double x) { return std::abs(x - middle); });
  return 1.4826 * Median(std::move(distance));
}

double WhiteNoise(const std::vector<std::vector<double>>& series) {
  std::vector<double> third;
  for (const std::vector<double>& x : series) {
    for (std::size_t k = 3; k < x.size(); ++k) {
      third.push_back(x[k] - 3 * x[k - 1] + 3 * x[k - 2] - x[k - 3]);
    }
  }
  return third.empty() ? 0 : RobustScale(third) / std::sqrt(20.0);
}

std::size_t CorrelationLength(std::span<const double> values, double level) {
  const std::size_t n = values.size();
  double mean = 0, energy = 0;
  for (const double x : values) mean += x / static_cast<double>(n);
  for (const double x : values) energy += (x - mean) * (x - mean);
  if (!(energy > 0)) return 1;
  const std::size_t last = std::max<std::size_t>(n / 4, 1);
  for (std::size_t lag = 1; lag < last; lag += 1 + lag / 8) {
    double product = 0;
    for (std::size_t k = lag; k < n; ++k) product += (values[k] - mean) * (values[k - lag] - mean);
    if (product < level * energy) return lag;
  }
  return last;
}

}  // namespace tera
