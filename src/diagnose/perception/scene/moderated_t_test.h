#pragma once

#include <cstddef>
#include <vector>

namespace tera {

/// Moderated t-test of whether values, one for each block of time, have a mean above a limit.
///
/// Model   Student's t over blocks, since what the rays of one block meet is the same. Two things
///         keep a few blocks that happen to agree from being sure: a variance shrunk to one known
///         before, as if so many more blocks had shown it, and a standard deviation of the mean
///         that is added to it.
/// Source  Smyth 2004, "Linear models and empirical Bayes methods" (moderated t).
struct ModeratedTTest {
  /// The mean of values, with its standard deviation and the degrees of freedom of that.
  struct Mean {
    double mean = 0, sigma = 0, dof = 0;
  };

  double limit = 0;
  std::size_t fewest_blocks = 2;  ///< fewer tell nothing: p is 1
  double prior_blocks = 0, prior_scatter = 0;
  double least_sigma = 0;  ///< of the mean

  /// At least one value.
  Mean MeanOf(const std::vector<double>& values) const;
  /// Probability of a mean so far above the limit by chance.
  double PFrom(const Mean& of) const;
  double P(const std::vector<double>& values) const;
};

}  // namespace tera
