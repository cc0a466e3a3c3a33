#pragma once

#include <cstddef>
#include <vector>

#include "diagnose/search/fit/replay_block.h"
#include "diagnose/search/structure/structure_search.h"
#include "diagnose/statistics/series/manoeuvres.h"

// Most of the search in a long recording uses a prefix of it. Persistent effects show there too.
// The replay of an axis can stop at the end of the prefix, which saves time.

namespace tera {

/// Samples of the shortest prefix with 60 s of commanded manoeuvres, or of the whole recording
/// where the prefix would save less than a third. `manoeuvres` must not be empty.
std::size_t PrefixLength(const std::vector<Manoeuvre>& manoeuvres, double period_s);

/// A block that consists of the first samples of `block`. Its replay calls that of `block`, which
/// must outlive it.
ReplayBlock PrefixOf(const ReplayBlock& block, std::size_t samples);

/// The manoeuvres that end within the first samples.
std::vector<Manoeuvre> Within(std::vector<Manoeuvre> manoeuvres, std::size_t samples);

/// Transfers the search of a prefix to the whole block. Terms and rivals refer to the candidates of
/// `whole`, which has the same candidates in the same order. Held parameters with a default become
/// free again at their starting values. Misfits keep the length of the prefix.
SearchResult CarryToWhole(SearchResult search, const ReplayBlock& prefix, const ReplayBlock& whole);

}  // namespace tera
