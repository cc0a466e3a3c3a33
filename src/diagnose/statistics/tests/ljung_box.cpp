#include "diagnose/statistics/tests/ljung_box.h"

#include <boost/math/distributions/chi_squared.hpp>

#include "core/check.h"

namespace tera {

LjungBoxResult LjungBox(const Series& innovations, std::size_t lags, std::size_t fitted) {
  const auto n = static_cast<double>(CountValid(innovations.valid));
  TERA_CHECK(lags > fitted, lags, fitted);
  TERA_CHECK(n > 2 * static_cast<double>(lags), n, lags);
  double mean = 0, variance = 0;
  for (const double e : ValidValues(innovations)) mean += e / n;
  for (const double e : ValidValues(innovations)) variance += (e - mean) * (e - mean) / n;
  LjungBoxResult out;
  out.degrees_of_freedom = static_cast<double>(lags - fitted);
  if (!(variance > 0)) return out;
  for (std::size_t lag = 1; lag <= lags; ++lag) {
    double product = 0, pairs = 0;
    for (std::size_t k = lag; k < innovations.size(); ++k) {
      if (!innovations.valid[k] || !innovations.valid[k - lag]) continue;
      product += (innovations.value[k] - mean) * (innovations.value[k - lag] - mean);
      ++pairs;
    }
    if (pairs > 0) out.statistic += product * product / (pairs * variance * variance);
  }
  out.statistic *= (n + 2) / n;
  const boost::math::chi_squared distribution(out.degrees_of_freedom);
  out.p = boost::math::cdf(boost::math::complement(distribution, out.statistic));
  return out;
}

}  // namespace tera
