#include "diagnose/perception/scans/shares_above.h"

#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <numeric>

namespace tera {

double SharesAbove::P(const std::vector<double>& shares) const {
  if (shares.size() < fewest_blocks) return 1;
  const auto n = static_cast<double>(shares.size());
  const double mean = std::accumulate(shares.begin(), shares.end(), 0.0) / n;
  double square = prior_blocks * prior_scatter * prior_scatter;
  for (const double s : shares) square += (s - mean) * (s - mean);
  const double dof = prior_blocks + n - 1;
  const double sigma = std::sqrt(square / dof / n + least_sigma * least_sigma);
  return boost::math::cdf(
      boost::math::complement(boost::math::students_t(dof), (mean - limit) / sigma));
}

}  // namespace tera
