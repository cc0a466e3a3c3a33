#pragma once

#include <vector>

#include "diagnose/diagnosis.h"

namespace tera {

/// A finding with its block.
struct FindingInBlock {
  const DiagnosedBlock* diagnosed = nullptr;
  const Finding* finding = nullptr;
};

/// An unexplained error with its block.
struct UnexplainedInBlock {
  const DiagnosedBlock* diagnosed = nullptr;
  const Unexplained* unexplained = nullptr;
};

/// Findings of a block, by descending removed error of their channel on FINAL. The gain in
/// log-likelihood would instead rank an effect that is faint in many manoeuvres above one that is
/// strong in few. The diagnosis must outlive the result.
std::vector<const Finding*> RankedFindings(const DiagnosedBlock& diagnosed);

/// Findings of all blocks, block by block. The block with the greatest total gain in log-likelihood
/// on held-out samples comes first; within a block as above.
std::vector<FindingInBlock> RankedFindings(const Diagnosis& diagnosis);

/// Unexplained errors, by the gain in log-likelihood that a flexible regressor reaches.
std::vector<UnexplainedInBlock> RankedUnexplained(const Diagnosis& diagnosis);

/// Whether a channel of a block has an unexplained residual.
bool IsLeft(const DiagnosedBlock& diagnosed, std::size_t channel);

}  // namespace tera
