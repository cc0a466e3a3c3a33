#pragma once

#include <cstddef>
#include <vector>

#include "diagnose/search/fit/replay_block.h"
#include "diagnose/search/structure/structure_search.h"
#include "diagnose/statistics/series/manoeuvres.h"

/// A long recording's prefix, on which most of a search is done: what acts all the time shows
/// there as well, for a fraction of the work where the replay can stop early, as that of an axis.

namespace tera {

/// Samples at the prefix of a block in which enough moves: 60 s of manoeuvres that are
/// commanded. All, where that would spare less than a third. At least one manoeuvre.
std::size_t PrefixLength(const std::vector<Manoeuvre>& manoeuvres, double period_s);

/// The first samples of a block as a block of its own, which asks the whole one for its
/// predictions. The whole one must outlive it.
ReplayBlock PrefixOf(const ReplayBlock& block, std::size_t samples);

/// Those that lie within the first samples.
std::vector<Manoeuvre> Within(std::vector<Manoeuvre> manoeuvres, std::size_t samples);

/// A search of a block's prefix with the block's own candidates in place of the prefix's, which
/// are the same in the same order. Numbers that the prefix does not determine are free again and
/// stand where a search would begin; fits of the prefix keep their length.
SearchResult CarryToWhole(SearchResult search, const ReplayBlock& prefix, const ReplayBlock& whole);

}  // namespace tera
