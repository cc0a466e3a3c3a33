#pragma once

#include <vector>

#include "diagnose/diagnosis.h"

namespace tera {

/// A finding and the block in which it was made.
struct FindingInBlock {
  const DiagnosedBlock* diagnosed = nullptr;
  const Finding* finding = nullptr;
};

/// An unexplained error and the block in which it is.
struct UnexplainedInBlock {
  const DiagnosedBlock* diagnosed = nullptr;
  const Unexplained* unexplained = nullptr;
};

/// The findings of a block, those that remove most of their channel's error on FINAL first. The
/// gain in log-likelihood would rank what acts faintly in each of many manoeuvres before what is
/// loud in a few. The diagnosis must outlive the result.
std::vector<const Finding*> RankedFindings(const DiagnosedBlock& diagnosed);

/// The findings of all blocks, block by block: first the block whose findings gain most in
/// log-likelihood on held-out samples, and within a block as above.
std::vector<FindingInBlock> RankedFindings(const Diagnosis& diagnosis);

/// Unexplained errors, ranked by the gain in log-likelihood of which a flexible regressor is
/// capable.
std::vector<UnexplainedInBlock> RankedUnexplained(const Diagnosis& diagnosis);

/// Whether anything is left unexplained in a channel of a block.
bool IsLeft(const DiagnosedBlock& diagnosed, std::size_t channel);

}  // namespace tera
