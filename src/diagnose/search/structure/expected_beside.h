#pragma once

#include <string>
#include <vector>

#include "diagnose/search/fit/replay_block.h"

namespace tera {

/// Whether a term is within tolerance: all its parameters with a stated tolerance are, and there is
/// at least one.
bool IsAsExpected(const Term& term);

/// The mechanism confined to its tolerances. Parameters with a tolerance move within it, the others
/// stay at their defaults. Without free parameters if none is stated.
Candidate HeldToExpected(Candidate candidate);

/// Whether a mechanism acts on a target in a structure, whichever candidate represents it.
bool ActsIn(const Structure& terms, const Candidate& candidate);

/// Whether a mechanism within tolerance may join a structure in which it does not act. Delays of a
/// target's commands share one tolerance, so at most one term within tolerance delays them.
bool MayJoin(const Structure& terms, const Candidate& candidate);

/// Mechanisms of a target that have a stated tolerance and may join a structure, each confined to
/// its tolerances.
std::vector<Candidate> ExpectedBeside(const ReplayBlock& block, const Structure& terms,
                                      const std::string& target);

}  // namespace tera
