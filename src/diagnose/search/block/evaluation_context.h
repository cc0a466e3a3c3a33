#pragma once

#include <vector>

#include "core/random.h"
#include "diagnose/search/fit/likelihood.h"
#include "diagnose/search/structure/structure_search.h"
#include "diagnose/statistics/series/manoeuvres.h"

namespace tera {

/// Inputs that all steps of a block's diagnosis share. All references must outlive it unchanged.
struct EvaluationContext {
  EvaluationContext(const ReplayBlock& block, const SearchOptions& options, const Stream& stream,
                    const std::vector<Manoeuvre>& manoeuvres, const std::vector<NoiseModel>& noise);

  const ReplayBlock& block;
  const SearchOptions& options;
  const Stream& stream;
  const std::vector<Manoeuvre>& manoeuvres;
  /// Samples of each part, cut into pieces (PiecesOf). `seen` is TRAIN and SELECT.
  const std::vector<Segment> select, seen, final;
  const Mask final_mask, seen_mask;
  const Likelihood likelihood;  ///< nuisance parameters fitted to TRAIN and SELECT
};

}  // namespace tera
