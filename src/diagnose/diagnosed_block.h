#pragma once

#include <vector>

#include "diagnose/learned/learn.h"
#include "diagnose/search/block/block_diagnosis.h"

namespace tera {

/// A block and its diagnosis. Findings point into the block's candidates, so this object can be
/// moved but not copied.
struct DiagnosedBlock {
  DiagnosedBlock() = default;
  DiagnosedBlock(DiagnosedBlock&&) = default;
  DiagnosedBlock& operator=(DiagnosedBlock&&) = default;

  ReplayBlock block;
  BlockDiagnosis diagnosis;
  std::vector<Learned> learned;  ///< of unexplained errors
};

}  // namespace tera
