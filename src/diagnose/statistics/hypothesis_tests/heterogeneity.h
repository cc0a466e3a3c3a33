#pragma once

#include <vector>

namespace tera {

/// A number with the standard deviation of its error.
struct UncertainNumber {
  double value = 0, sigma = 0;
};

/// One quantity with several measurements.
struct PooledNumber {
  double value = 0, sigma = 0;
  double between = 0;  ///< standard deviation between measurements, beyond their errors
  double p = 1;        ///< of the scatter, under a constant quantity
};

/// Pools one or more measurements of a possibly constant quantity, each with a sigma above 0.
///
/// Model   p by Cochran's Q, chi-squared with one degree of freedom less than there are values. The
///         variance between measurements is estimated by moments. Each value is weighted by the
///         inverse of the sum of both variances.
/// Omits   common parts of the errors, which averaging does not reduce.
/// Source  Cochran 1954; DerSimonian and Laird 1986, "Meta-analysis in clinical trials".
PooledNumber Pool(const std::vector<UncertainNumber>& values);

}  // namespace tera
