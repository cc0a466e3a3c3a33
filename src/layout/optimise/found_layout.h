#pragma once

#include <optional>
#include <string>
#include <vector>

#include "layout/optimise/candidate.h"

namespace tera {

/// A layout on the Pareto front of a search.
struct FoundLayout {
  Genes genes;
  std::vector<double> objectives;  ///< as in Appraised
};

struct OptimiseResult {
  std::vector<FoundLayout> front;     ///< sorted by the first objective
  std::optional<FoundLayout> greedy;  ///< empty if it violates the limits
  std::vector<std::string> warnings;  ///< about the search space
};

}  // namespace tera
