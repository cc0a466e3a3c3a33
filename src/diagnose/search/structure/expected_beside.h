#pragma once

#include <string>
#include <vector>

#include "diagnose/search/fit/replay_block.h"

namespace tera {

/// True if at least one parameter has a stated tolerance, and all such parameters lie within
/// theirs.
bool IsAsExpected(const Term& term);

/// The candidate restricted to its tolerances: free parameters are those with a stated tolerance,
/// and they stay within it. The others keep their defaults. Without stated tolerances, no parameter
/// is free.
Candidate HeldToExpected(Candidate candidate);

/// True if a structure contains the candidate's mechanism on the candidate's target.
bool ActsIn(const Structure& terms, const Candidate& candidate);

/// HeldToExpected with what a structure leaves of the tolerance of delays, which all delays of one
/// target's commands share. Terms within tolerance use it in proportion to their values.
Candidate HeldBeside(Candidate candidate, const Structure& terms);

/// Candidates of a target that have a stated tolerance and do not act in the structure, each as by
/// HeldBeside.
std::vector<Candidate> ExpectedBeside(const ReplayBlock& block, const Structure& terms,
                                      const std::string& target);

}  // namespace tera
