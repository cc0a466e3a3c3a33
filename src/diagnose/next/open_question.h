#pragma once

#include <string>
#include <vector>

#include "diagnose/search/block/block_diagnosis.h"

namespace tera {

/// Two accounts of one block: would a run of levers tell that the first is true, not the second?
struct OpenQuestion {
  Structure truth, instead;
};

/// What a recording left open of one block: explanations of which it does not say which one holds.
struct OpenMatter {
  std::vector<std::string> members;  ///< identifiers; "nothing" for no effect
  bool is_class = false;             ///< of a finding; else of a mechanism that was not testable
  std::vector<OpenQuestion> questions;
};

/// What is left open of a block: each finding's class, every member against every other and against
/// none of them; each mechanism that could not have been seen, of half its largest size, against
/// nothing, with all that was found at work. Members of a class are fitted to TRAIN and SELECT.
/// The terms point to the block's suspects.
std::vector<OpenMatter> OpenMattersOf(const ReplayBlock& block, const BlockDiagnosis& diagnosis);

}  // namespace tera
