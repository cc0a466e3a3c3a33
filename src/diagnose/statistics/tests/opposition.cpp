#include "diagnose/statistics/tests/opposition.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <vector>

#include "diagnose/statistics/series/robust.h"

namespace tera {
namespace {

constexpr std::size_t kLengths = 2;         ///< length of a block in correlation lengths
constexpr std::size_t kFewestSamples = 10;  ///< smallest length of a block
constexpr std::size_t kFewestBlocks = 3;
constexpr double kLeastPower = 0.1;  ///< smallest power of a block, over the mean power

double Product(std::span<const double> a, std::span<const double> b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
  return sum;
}

/// Uncentred correlations of the blocks in which both series have enough power.
std::vector<double> CorrelationsOf(std::span<const double> a, std::span<const double> b) {
  const std::size_t size =
      std::max(kFewestSamples, kLengths * std::max(CorrelationLength(a), CorrelationLength(b)));
  const double share = kLeastPower * static_cast<double>(size) / static_cast<double>(a.size());
  const double least_a = share * Product(a, a), least_b = share * Product(b, b);
  std::vector<double> correlations;
  for (std::size_t from = 0; from + size <= a.size(); from += size) {
    const auto one = a.subspan(from, size), two = b.subspan(from, size);
    const double power_a = Product(one, one), power_b = Product(two, two);
    if (power_a <= 0 || power_b <= 0 || power_a < least_a || power_b < least_b) continue;
    correlations.push_back(Product(one, two) / std::sqrt(power_a * power_b));
  }
  return correlations;
}

}  // namespace

double OppositionP(std::span<const double> a, std::span<const double> b) {
  const std::vector<double> correlations = CorrelationsOf(a, b);
  if (correlations.size() < kFewestBlocks) return 1;
  const auto count = static_cast<double>(correlations.size());
  double mean = 0, square = 0;
  for (const double r : correlations) mean += r / count;
  for (const double r : correlations) square += (r - mean) * (r - mean);
  const double error = std::sqrt(square / (count - 1) / count);
  if (error <= 0) return mean < 0 ? 0 : 1;
  return boost::math::cdf(boost::math::students_t(count - 1), mean / error);
}

}  // namespace tera
