#pragma once

#include <cstddef>
#include <vector>

namespace tera {

/// Whether shares of rays, one for each block of time, lie above a limit.
///
/// Model   Student's t of their mean, over blocks, since what rays of one block meet is the same.
///         Two things keep a few blocks that happen to agree from being sure: a variance shrunk to
///         one known before, as if so many more blocks had shown it (moderated t), and a standard
///         deviation of the mean that is added to it.
/// Source  Smyth 2004, "Linear models and empirical Bayes methods" (moderated t).
struct SharesAbove {
  double limit = 0;
  std::size_t fewest_blocks = 2;  ///< fewer tell nothing: p is 1
  double prior_blocks = 0, prior_scatter = 0;
  double least_sigma = 0;  ///< of the mean

  /// Probability of a mean so far above the limit by chance.
  double P(const std::vector<double>& shares) const;
};

}  // namespace tera
