#pragma once

#include <optional>

#include "diagnose/search/block/evaluation_context.h"
#include "diagnose/search/structure/structure_search.h"

namespace tera {

/// Smallest size of a candidate that the diagnosis would find if noise were its only limit.
struct Detectability {
  const Candidate* candidate = nullptr;
  /// Value of its main parameter; empty if the diagnosis would find none of the tested values.
  std::optional<double> smallest;
};

/// Tests the candidate's starts from faint to strong, with known parameters. Returns the first
/// start that passes in three quarters of twenty noise draws: both the test on TRAIN and SELECT and
/// the test on FINAL.
Detectability DetectabilityOf(const EvaluationContext& context, const Candidate& candidate);

}  // namespace tera
