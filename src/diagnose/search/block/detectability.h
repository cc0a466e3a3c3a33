#pragma once

#include <optional>

#include "diagnose/search/block/evaluation_context.h"
#include "diagnose/search/structure/structure_search.h"

namespace tera {

/// Smallest size at which a candidate would have been found, limited by noise alone.
struct Detectability {
  const Candidate* candidate = nullptr;
  std::optional<double> smallest;  ///< of its main parameter; none if no start would be found
};

/// Tests the candidate's starts from faint to strong, with their numbers assumed known. Returns the
/// first that passes the tests of TRAIN with SELECT and of FINAL in three quarters of twenty noise
/// draws.
Detectability DetectabilityOf(const EvaluationContext& context, const Candidate& candidate);

}  // namespace tera
