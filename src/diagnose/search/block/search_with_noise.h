#pragma once

#include <vector>

#include "core/random.h"
#include "diagnose/search/fit/likelihood.h"
#include "diagnose/search/structure/search_result.h"
#include "diagnose/statistics/series/manoeuvres.h"

namespace tera {

/// A search, and the noise estimated together with its result.
struct SearchedBlock {
  std::vector<NoiseModel> noise;
  SearchResult search;
};

/// Searches a testable block (testable.h) for the mechanisms that explain it.
///
/// Model   noise estimation and search alternate, at most three times, while any channel's noise
///         variance halves or the scale of its innovations falls below 0.7 of the previous one. An
///         unexplained error can pass for noise at first. A long block is searched by its prefix
///         first (prefix_search.h), then from the prefix's result under noise estimated with it.
SearchedBlock SearchBlock(const ReplayBlock& block, const SearchOptions& options,
                          const Stream& stream, const std::vector<Manoeuvre>& manoeuvres);

}  // namespace tera
