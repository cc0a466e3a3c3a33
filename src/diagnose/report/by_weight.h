#pragma once

#include <vector>

#include "diagnose/diagnosis.h"

namespace tera {

/// A finding with the block that it was made in.
struct FindingInBlock {
  const DiagnosedBlock* diagnosed = nullptr;
  const Finding* finding = nullptr;
};

/// The same of what is left unexplained.
struct UnexplainedInBlock {
  const DiagnosedBlock* diagnosed = nullptr;
  const Unexplained* unexplained = nullptr;
};

/// All that a diagnosis found, by what each gained in log-likelihood on held-out samples, the most
/// first; equals in the order of the blocks. The diagnosis must outlive it.
std::vector<FindingInBlock> FindingsByWeight(const Diagnosis& diagnosis);
std::vector<const Finding*> FindingsByWeight(const DiagnosedBlock& diagnosed);
std::vector<UnexplainedInBlock> UnexplainedByWeight(const Diagnosis& diagnosis);

/// Whether anything is left unexplained in a channel of a block.
bool IsLeft(const DiagnosedBlock& diagnosed, std::size_t channel);

}  // namespace tera
