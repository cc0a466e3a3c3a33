#pragma once

#include <optional>
#include <string>
#include <vector>

#include "layout/optimise/candidate.h"

namespace tera {

/// A layout of the front that a search found.
struct FoundLayout {
  Genes genes;
  std::vector<double> objectives;  ///< as Appraised has them
};

/// What a search ends with.
struct OptimiseResult {
  std::vector<FoundLayout> front;     ///< by the first objective
  std::optional<FoundLayout> greedy;  ///< nothing where it is not within the limits
  std::vector<std::string> warnings;  ///< of what may be searched
};

}  // namespace tera
