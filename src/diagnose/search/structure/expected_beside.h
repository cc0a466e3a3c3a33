#pragma once

#include <string>
#include <vector>

#include "diagnose/search/fit/replay_block.h"

namespace tera {

/// Whether a mechanism acts on a target in a structure, whichever candidate stands for it.
bool ActsIn(const Structure& terms, const Candidate& candidate);

/// The mechanisms of a target of which something is stated and that do not act in a structure, each
/// held to what is as expected: their numbers move within their tolerances, those of which nothing
/// is stated stay at their defaults.
std::vector<Candidate> ExpectedBeside(const ReplayBlock& block, const Structure& terms,
                                      const std::string& target);

}  // namespace tera
