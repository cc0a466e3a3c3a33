#pragma once

#include <cstddef>
#include <vector>

namespace tera {

/// Moderated t-test of whether values, one for each block of time, have a mean above a limit.
///
/// Model   Student's t over blocks, since the rays of one block meet the same surfaces. Two terms
///         keep a few blocks that agree by chance from being significant. A prior with the weight
///         of additional blocks shrinks the variance. A further standard deviation adds to that of
///         the mean.
/// Source  Smyth 2004, "Linear models and empirical Bayes methods" (moderated t).
struct ModeratedTTest {
  /// Mean of values, with its standard deviation and degrees of freedom.
  struct Mean {
    double mean = 0, sigma = 0, dof = 0;
  };

  double limit = 0;
  std::size_t fewest_blocks = 2;  ///< with fewer, p is 1
  double prior_blocks = 0, prior_scatter = 0;
  double least_sigma = 0;  ///< of the mean

  /// Needs at least one value.
  Mean MeanOf(const std::vector<double>& values) const;
  /// p-value of a mean so far above the limit.
  double PFrom(const Mean& of) const;
  double P(const std::vector<double>& values) const;
};

}  // namespace tera
