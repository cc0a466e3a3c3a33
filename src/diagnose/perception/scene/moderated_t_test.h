#pragma once

#include <cstddef>
#include <vector>

namespace tera {

/// Moderated t-test for a mean above a limit, with one value per block of time.
///
/// Model   Student's t over blocks, because the rays of one block hit the same surfaces. Two terms
///         prevent significance when a few blocks agree by chance. A prior with the weight of
///         `prior_blocks` blocks and the scatter `prior_scatter` moderates the variance.
///         `least_sigma` is added, in quadrature, to the standard deviation of the mean.
/// Source  Smyth 2004, "Linear models and empirical Bayes methods" (moderated t).
struct ModeratedTTest {
  /// Mean of the values, its standard deviation and its degrees of freedom.
  struct Mean {
    double mean = 0, sigma = 0, dof = 0;
  };

  double limit = 0;
  std::size_t fewest_blocks = 2;  ///< p is 1 with fewer blocks
  double prior_blocks = 0, prior_scatter = 0;
  double least_sigma = 0;  ///< least standard deviation of the mean

  /// Needs at least one value.
  Mean MeanOf(const std::vector<double>& values) const;
  /// p-value of a mean at least this far above the limit.
  double PFrom(const Mean& of) const;
  double P(const std::vector<double>& values) const;
};

}  // namespace tera
