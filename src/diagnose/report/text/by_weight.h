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

/// What a block found, by how much of its channel's error each takes away on FINAL, the most first.
/// A gain in log-likelihood would put what acts in each of many manoeuvres, faintly, before what is
/// loud in a few. The diagnosis must outlive it.
std::vector<const Finding*> FindingsByWeight(const DiagnosedBlock& diagnosed);
/// The same, block by block, those first whose findings gain most log-likelihood on held-out
/// samples.
std::vector<FindingInBlock> FindingsByWeight(const Diagnosis& diagnosis);
/// By the gain in log-likelihood of what a flexible regressor could explain.
std::vector<UnexplainedInBlock> UnexplainedByWeight(const Diagnosis& diagnosis);

/// Whether anything is left unexplained in a channel of a block.
bool IsLeft(const DiagnosedBlock& diagnosed, std::size_t channel);

}  // namespace tera
