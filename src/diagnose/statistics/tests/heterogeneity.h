#pragma once

#include <vector>

namespace tera {

struct UncertainNumber {
  double value = 0, sigma = 0;
};

/// A quantity pooled from several measurements.
struct PooledNumber {
  double value = 0, sigma = 0;
  double between = 0;  ///< standard deviation between measurements, beyond their errors
  double p = 1;        ///< p-value of the scatter if the quantity is constant
};

/// Pools one or more measurements of a quantity that may be constant. Each sigma must be above 0.
///
/// Model   p by Cochran's Q, chi-squared with (values - 1) degrees of freedom. The variance between
///         measurements is estimated by moments. The weight of a value is the inverse of the sum of
///         its own variance and that between measurements.
/// Omits   errors common to all values, which averaging does not reduce.
/// Source  Cochran 1954; DerSimonian and Laird 1986, "Meta-analysis in clinical trials".
PooledNumber Pool(const std::vector<UncertainNumber>& values);

}  // namespace tera
