#pragma once

#include <vector>

namespace tera {

/// Holm's adjusted p-values, in the order given: rejecting those at or below alpha keeps the
/// probability of any false rejection at alpha, whatever the dependence.
/// Source  Holm 1979, "A simple sequentially rejective multiple test procedure".
std::vector<double> HolmAdjusted(const std::vector<double>& p);

}  // namespace tera
