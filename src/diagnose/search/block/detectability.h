#pragma once

#include <optional>

#include "diagnose/search/block/evaluation_context.h"
#include "diagnose/search/structure/structure_search.h"

namespace tera {

/// The smallest size at which a candidate would have been found, were noise the only trouble.
struct Detectability {
  const Candidate* candidate = nullptr;
  std::optional<double> smallest;  ///< of its main number; none where no start would be found
};

/// Takes the candidate's starts, from faint to strong, and returns the first that would pass the
/// tests of TRAIN with SELECT and of FINAL under three quarters of twenty draws of the noise, its
/// numbers being known.
Detectability DetectabilityOf(const EvaluationContext& context, const Candidate& candidate);

}  // namespace tera
