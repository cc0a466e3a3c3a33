#include "diagnose/statistics/tests/variance_ratio.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

#include "core/check.h"
#include "diagnose/statistics/series/robust.h"

namespace tera {
namespace {

struct Energy {
  double mean = 0;
  double relative_variance = 0;  ///< of the mean, over its square
  double blocks = 0;
};

Energy MeasureEnergy(const std::vector<double>& value, double limit, std::size_t block) {
  std::vector<double> means;
  for (std::size_t begin = 0; begin + block <= value.size(); begin += block) {
    double sum = 0;
    for (std::size_t k = begin; k < begin + block; ++k) {
      const double x = std::clamp(value[k], -limit, limit);
      sum += x * x;
    }
    means.push_back(sum / static_cast<double>(block));
  }
  TERA_CHECK(means.size() >= 2, means.size());
  Energy out;
  out.blocks = static_cast<double>(means.size());
  for (const double m : means) out.mean += m / out.blocks;
  double scatter = 0;
  for (const double m : means) scatter += (m - out.mean) * (m - out.mean);
  out.relative_variance = scatter / (out.blocks - 1) / out.blocks / (out.mean * out.mean);
  return out;
}

}  // namespace

VarianceRatioResult VarianceRatio(const Series& judged, const Series& reference,
                                  const VarianceRatioOptions& options) {
  const std::vector<double> a = ValidValues(judged), b = ValidValues(reference);
  TERA_CHECK(!a.empty() && !b.empty());
  const std::size_t shorter = std::min(a.size(), b.size());
  const std::size_t block =
      options.block > 0 ? options.block : std::max<std::size_t>(shorter / 30, 20);
  const double limit = options.clip * std::max(RobustScale(b), 1e-300);
  const Energy of_a = MeasureEnergy(a, limit, block), of_b = MeasureEnergy(b, limit, block);
  VarianceRatioResult out;
  out.ratio = of_a.mean / of_b.mean;
  const double va = of_a.relative_variance, vb = of_b.relative_variance;
  if (!(va + vb > 0)) return out;
  const double freedom =
      (va + vb) * (va + vb) / (va * va / (of_a.blocks - 1) + vb * vb / (of_b.blocks - 1));
  const boost::math::students_t distribution(freedom);
  out.p = boost::math::cdf(
      boost::math::complement(distribution, std::log(out.ratio) / std::sqrt(va + vb)));
  return out;
}

}  // namespace tera
