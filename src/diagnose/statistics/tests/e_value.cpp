#include "diagnose/statistics/tests/e_value.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"

namespace tera {

EValue CombineFolds(const std::vector<HeldOutFold>& folds) {
  TERA_CHECK(!folds.empty());
  const auto gain = [](const HeldOutFold& fold) {
    return fold.alternative_log_likelihood - fold.null_log_likelihood;
  };
  double largest = -INFINITY;
  for (const HeldOutFold& fold : folds) largest = std::max(largest, gain(fold));
  double sum = 0;
  for (const HeldOutFold& fold : folds) sum += std::exp(gain(fold) - largest);
  EValue out;
  out.log_e = largest + std::log(sum / static_cast<double>(folds.size()));
  out.p = std::min(1.0, std::exp(-out.log_e));
  return out;
}

}  // namespace tera
