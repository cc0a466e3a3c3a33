#pragma once

#include <vector>

namespace tera {

/// Holm's adjusted p-values, in the order of `p`. Rejecting those up to alpha bounds the
/// probability of any false rejection by alpha, under any dependence.
/// Source  Holm 1979, "A simple sequentially rejective multiple test procedure".
std::vector<double> HolmAdjusted(const std::vector<double>& p);

}  // namespace tera
