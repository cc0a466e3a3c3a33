#pragma once

#include <cstddef>

namespace tera {

struct Interval {
  double low = 0, high = 0;
};

/// Wilson's interval of a proportion: `successes` of `trials` (at least 1), at the given
/// confidence. Source  Wilson 1927, "Probable inference, the law of succession, and statistical
/// inference".
Interval WilsonInterval(std::size_t successes, std::size_t trials, double confidence = 0.95);

}  // namespace tera
