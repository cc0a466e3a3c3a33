#pragma once

#include <vector>

namespace tera {

/// A number with the standard deviation of its error.
struct UncertainNumber {
  double value = 0, sigma = 0;
};

/// One number that was measured several times.
struct PooledNumber {
  double value = 0, sigma = 0;
  double between = 0;  ///< standard deviation from one time to another, beyond the errors
  double p = 1;  ///< probability, by chance, of values so far apart if the number was the same
};

/// Pools several measurements of what may be one number, at least one, each with a sigma above 0.
///
/// Model   p by Cochran's Q, chi-squared with one degree of freedom less than there are values.
///         What the number differs by is estimated by moments; each value is weighted by the
///         inverse of the sum of both variances.
/// Omits   that errors may have a part in common, which a mean does not lessen.
/// Source  Cochran 1954; DerSimonian and Laird 1986, "Meta-analysis in clinical trials".
PooledNumber Pool(const std::vector<UncertainNumber>& values);

}  // namespace tera
