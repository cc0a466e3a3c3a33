#include "diagnose/perception/scene/moderated_t_test.h"

#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <numeric>

namespace tera {

ModeratedTTest::Mean ModeratedTTest::MeanOf(const std::vector<double>& values) const {
  const auto n = static_cast<double>(values.size());
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  double square = prior_blocks * prior_scatter * prior_scatter;
  for (const double value : values) square += (value - mean) * (value - mean);
  const double dof = prior_blocks + n - 1;
  return {mean, std::sqrt(square / dof / n + least_sigma * least_sigma), dof};
}

double ModeratedTTest::PFrom(const Mean& of) const {
  return boost::math::cdf(
      boost::math::complement(boost::math::students_t(of.dof), (of.mean - limit) / of.sigma));
}

double ModeratedTTest::P(const std::vector<double>& values) const {
  return values.size() < fewest_blocks ? 1 : PFrom(MeanOf(values));
}

}  // namespace tera
