#include "diagnose/statistics/tests/heterogeneity.h"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>

#include "core/check.h"

namespace tera {
namespace {

/// Weighted mean. Weights are the inverse of sigma^2 + `between`^2.
PooledNumber WeightedMean(const std::vector<UncertainNumber>& values, double between) {
  double sum = 0, weights = 0;
  for (const UncertainNumber& one : values) {
    const double weight = 1 / (one.sigma * one.sigma + between * between);
    sum += weight * one.value;
    weights += weight;
  }
  return {sum / weights, std::sqrt(1 / weights), between, 1};
}

}  // namespace

PooledNumber Pool(const std::vector<UncertainNumber>& values) {
  TERA_CHECK(!values.empty());
  for (const UncertainNumber& one : values) TERA_CHECK(one.sigma > 0);
  const PooledNumber same = WeightedMean(values, 0);
  if (values.size() == 1) return same;
  double q = 0, weights = 0, squares = 0;
  for (const UncertainNumber& one : values) {
    const double weight = 1 / (one.sigma * one.sigma);
    q += weight * (one.value - same.value) * (one.value - same.value);
    weights += weight;
    squares += weight * weight;
  }
  const double freedom = static_cast<double>(values.size() - 1);
  const double between_squared = std::max(0.0, (q - freedom) / (weights - squares / weights));
  PooledNumber pooled = WeightedMean(values, std::sqrt(between_squared));
  pooled.p = boost::math::cdf(boost::math::complement(boost::math::chi_squared(freedom), q));
  return pooled;
}

}  // namespace tera
