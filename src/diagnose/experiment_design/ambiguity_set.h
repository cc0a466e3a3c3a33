#pragma once

#include <string>
#include <vector>

#include "diagnose/search/block/block_diagnosis.h"

namespace tera {

/// Two hypotheses on one block. An experiment should show that the first is true and the second is
/// not.
struct RivalPair {
  Structure truth, alternative;
};

/// Hypotheses on one block that a recording does not discriminate.
struct AmbiguitySet {
  std::vector<std::string> members;  ///< identifiers; "nothing" for no effect
  bool is_class = false;             ///< class of a finding; else a mechanism that was not testable
  std::vector<RivalPair> pairs;
};

/// The ambiguity sets that a diagnosis leaves for a block. Each finding's class is one: every
/// member against every other, and against none. Each undetectable mechanism is one: half of its
/// largest size, added to all findings, against nothing. Members of a class are fitted to TRAIN and
/// SELECT. The terms point to the block's candidates.
std::vector<AmbiguitySet> AmbiguitySetsOf(const ReplayBlock& block,
                                          const BlockDiagnosis& diagnosis);

}  // namespace tera
