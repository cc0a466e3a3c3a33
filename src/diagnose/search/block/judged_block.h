#pragma once

#include <vector>

#include "core/random.h"
#include "diagnose/search/fit/likelihood.h"
#include "diagnose/search/structure/structure_search.h"
#include "diagnose/statistics/series/manoeuvres.h"

namespace tera {

/// A block under one noise, with its manoeuvres by what they may be used for. All that it is made
/// of must outlive it and stay as it is.
struct JudgedBlock {
  JudgedBlock(const ReplayBlock& block, const SearchOptions& options, const Stream& stream,
              const std::vector<Manoeuvre>& manoeuvres, const std::vector<NoiseModel>& noise);

  const ReplayBlock& block;
  const SearchOptions& options;
  const Stream& stream;
  const std::vector<Manoeuvre>& manoeuvres;
  const std::vector<Segment> select, seen, final;  ///< in pieces; seen: TRAIN and SELECT
  const Mask final_mask, seen_mask;
  const Likelihood likelihood;  ///< of TRAIN and SELECT
};

}  // namespace tera
