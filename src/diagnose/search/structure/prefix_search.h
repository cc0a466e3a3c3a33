#pragma once

#include <cstddef>
#include <vector>

#include "diagnose/search/fit/replay_block.h"
#include "diagnose/search/structure/structure_search.h"
#include "diagnose/statistics/series/manoeuvres.h"

// A prefix of a long recording, on which most of a search is done. What acts all the time shows
// there as well, for a fraction of the work where the replay can stop early, as that of an axis
// can.

namespace tera {

/// Samples of the prefix, at whose end 60 s of commanded manoeuvres are complete; all of the
/// recording where that would spare less than a third. There must be at least one manoeuvre.
std::size_t PrefixLength(const std::vector<Manoeuvre>& manoeuvres, double period_s);

/// The first samples of a block as a block of its own, which asks the whole one for its
/// predictions. The whole one must outlive it.
ReplayBlock PrefixOf(const ReplayBlock& block, std::size_t samples);

/// The manoeuvres that lie within the first samples.
std::vector<Manoeuvre> Within(std::vector<Manoeuvre> manoeuvres, std::size_t samples);

/// Carries the search of a prefix to the whole block: terms and rivals point to the whole block's
/// candidates, which are the same in the same order. Numbers that the prefix did not determine and
/// that have a default are free again, at the values where a search starts. The misfits of `search`
/// keep the prefix's length.
SearchResult CarryToWhole(SearchResult search, const ReplayBlock& prefix, const ReplayBlock& whole);

}  // namespace tera
