#pragma once

#include <vector>

#include "core/random.h"
#include "diagnose/search/fit/likelihood.h"
#include "diagnose/search/structure/search_result.h"
#include "diagnose/statistics/series/manoeuvres.h"

namespace tera {

/// A search and the noise that was estimated beside what it found.
struct SearchedBlock {
  std::vector<NoiseModel> noise;
  SearchResult search;
};

/// Searches a block that is testable (testable.h) for what explains it.
///
/// Model   noise is estimated and searched under in turn, three times at most, while any channel's
///         falls by half or its innovations by a third: what is found may have passed for noise at
///         first. A long block is searched by its prefix first (prefix_search.h), then from what
///         was found there, under noise estimated beside that.
SearchedBlock SearchBlock(const ReplayBlock& block, const SearchOptions& options,
                          const Stream& stream, const std::vector<Manoeuvre>& manoeuvres);

}  // namespace tera
