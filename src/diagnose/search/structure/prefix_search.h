#pragma once

#include <cstddef>
#include <vector>

#include "diagnose/search/fit/replay_block.h"
#include "diagnose/search/structure/structure_search.h"
#include "diagnose/statistics/series/manoeuvres.h"

// A prefix of a long recording, to which most of a search is restricted. Persistent effects show
// there too, at a fraction of the cost if the replay can stop early, as an axis's can.

namespace tera {

/// Samples of the shortest prefix with 60 s of commanded manoeuvres. The whole recording if a
/// prefix would save less than a third. There must be at least one manoeuvre.
std::size_t PrefixLength(const std::vector<Manoeuvre>& manoeuvres, double period_s);

/// The first samples of a block as a block of its own, predicted by the whole block, which must
/// outlive it.
ReplayBlock PrefixOf(const ReplayBlock& block, std::size_t samples);

/// The manoeuvres within the first samples.
std::vector<Manoeuvre> Within(std::vector<Manoeuvre> manoeuvres, std::size_t samples);

/// Transfers a prefix's search to the whole block: terms and rivals refer to the whole block's
/// candidates, which are the same in the same order. Held parameters with a default become free
/// again, at their starting values. The misfits of `search` keep the prefix's length.
SearchResult CarryToWhole(SearchResult search, const ReplayBlock& prefix, const ReplayBlock& whole);

}  // namespace tera
