#include "diagnose/statistics/tests/proportion.h"

#include <boost/math/distributions/normal.hpp>
#include <cmath>

#include "core/check.h"

namespace tera {

Interval WilsonInterval(std::size_t successes, std::size_t trials, double confidence) {
  TERA_CHECK(trials > 0 && successes <= trials, successes, trials);
  const double z = boost::math::quantile(boost::math::normal(), 0.5 + confidence / 2);
  const auto n = static_cast<double>(trials);
  const double share = static_cast<double>(successes) / n;
  const double centre = share + z * z / (2 * n);
  const double half = z * std::sqrt(share * (1 - share) / n + z * z / (4 * n * n));
  return {(centre - half) / (1 + z * z / n), (centre + half) / (1 + z * z / n)};
}

}  // namespace tera
