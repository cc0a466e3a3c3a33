#pragma once

#include <vector>

#include "core/random.h"
#include "diagnose/search/fit/likelihood.h"
#include "diagnose/search/structure/structure_search.h"
#include "diagnose/statistics/series/manoeuvres.h"

namespace tera {

/// What every step of a block's diagnosis is evaluated with: the block, one model of its noise, and
/// its manoeuvres by what they may be used for. All that it is made of must outlive it and stay as
/// it is.
struct EvaluationContext {
  EvaluationContext(const ReplayBlock& block, const SearchOptions& options, const Stream& stream,
                    const std::vector<Manoeuvre>& manoeuvres, const std::vector<NoiseModel>& noise);

  const ReplayBlock& block;
  const SearchOptions& options;
  const Stream& stream;
  const std::vector<Manoeuvre>& manoeuvres;
  /// The samples of each part, in pieces (PiecesOf); `seen` is TRAIN and SELECT.
  const std::vector<Segment> select, seen, final;
  const Mask final_mask, seen_mask;
  const Likelihood likelihood;  ///< of TRAIN and SELECT
};

}  // namespace tera
