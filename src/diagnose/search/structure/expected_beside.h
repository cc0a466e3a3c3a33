#pragma once

#include <string>
#include <vector>

#include "diagnose/search/fit/replay_block.h"

namespace tera {

/// Whether all numbers of a term of which something is stated are as expected, one at least.
bool IsAsExpected(const Term& term);

/// The mechanism held to what is as expected of it: its numbers move within their tolerances, those
/// of which nothing is stated stay at their defaults. Without free numbers where nothing is stated.
Candidate HeldToExpected(Candidate candidate);

/// Whether a mechanism acts on a target in a structure, whichever candidate stands for it.
bool ActsIn(const Structure& terms, const Candidate& candidate);

/// The mechanisms of a target of which something is stated and that do not act in a structure, each
/// held to what is as expected.
std::vector<Candidate> ExpectedBeside(const ReplayBlock& block, const Structure& terms,
                                      const std::string& target);

}  // namespace tera
