#pragma once

#include <vector>

#include "core/random.h"
#include "diagnose/search/fit/likelihood.h"
#include "diagnose/search/structure/search_result.h"
#include "diagnose/statistics/series/manoeuvres.h"

namespace tera {

struct SearchedBlock {
  std::vector<NoiseModel> noise;
  SearchResult search;
};

/// Searches a testable block (testable.h) for the mechanisms that explain it.
///
/// Model   an unexplained error can pass for noise at first. Noise estimation and search therefore
///         alternate, at most three times. They repeat while the noise variance of any channel
///         falls below half, or the scale of its innovations below 0.7, of the previous value. A
///         long block is searched on its prefix first (prefix_search.h). The search of the whole
///         block starts from that result, under noise estimated with it.
SearchedBlock SearchBlock(const ReplayBlock& block, const SearchOptions& options,
                          const Stream& stream, const std::vector<Manoeuvre>& manoeuvres);

}  // namespace tera
