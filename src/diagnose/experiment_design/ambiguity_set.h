#pragma once

#include <string>
#include <vector>

#include "diagnose/search/block/block_diagnosis.h"

namespace tera {

/// Two explanations of one block, of which an experiment should tell that the first is true and not
/// the second.
struct RivalPair {
  Structure truth, alternative;
};

/// Explanations of one block between which a recording does not decide.
struct AmbiguitySet {
  std::vector<std::string> members;  ///< identifiers; "nothing" for no effect
  bool is_class = false;             ///< of a finding; else of a mechanism that was not testable
  std::vector<RivalPair> pairs;
};

/// The ambiguity sets that a diagnosis leaves of a block. Each finding's class makes one: every
/// member against every other one and against none of them. Each mechanism that could not have been
/// seen makes one: half of its largest size, beside all that was found, against nothing. Members of
/// a class are fitted to TRAIN and SELECT. The terms point to the block's candidates.
std::vector<AmbiguitySet> AmbiguitySetsOf(const ReplayBlock& block,
                                          const BlockDiagnosis& diagnosis);

}  // namespace tera
