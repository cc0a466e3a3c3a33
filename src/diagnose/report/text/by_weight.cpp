#include "diagnose/report/text/by_weight.h"

#include <algorithm>
#include <cmath>

namespace tera {
namespace {

/// What a finding takes from the mean square of its channel's error on FINAL, of what there was.
double TakenBy(const DiagnosedBlock& diagnosed, const Finding& finding) {
  const HeldOutError& error = finding.held_out;
  double at_first = 0;
  for (const HeldOutError& all : diagnosed.diagnosis.confirmed) {
    if (all.channel == error.channel) at_first = all.rmse_before;
  }
  const double taken = std::pow(error.rmse_before, 2) - std::pow(error.rmse_after, 2);
  return at_first > 0 ? taken / (at_first * at_first) : taken;
}

/// Of a block, by what its findings gain in log-likelihood, each over the structure without it.
double WeightOf(const DiagnosedBlock& diagnosed) {
  double share = 0;
  for (const Finding& finding : diagnosed.diagnosis.findings) share += finding.evidence.share;
  return share * diagnosed.diagnosis.search.flexible_gain;
}

}  // namespace

std::vector<const Finding*> FindingsByWeight(const DiagnosedBlock& diagnosed) {
  std::vector<const Finding*> all;
  for (const Finding& finding : diagnosed.diagnosis.findings) all.push_back(&finding);
  std::stable_sort(all.begin(), all.end(), [&](const Finding* a, const Finding* b) {
    return TakenBy(diagnosed, *a) > TakenBy(diagnosed, *b);
  });
  return all;
}

std::vector<FindingInBlock> FindingsByWeight(const Diagnosis& diagnosis) {
  std::vector<const DiagnosedBlock*> blocks;
  for (const DiagnosedBlock& diagnosed : diagnosis.blocks) blocks.push_back(&diagnosed);
  std::stable_sort(
      blocks.begin(), blocks.end(),
      [](const DiagnosedBlock* a, const DiagnosedBlock* b) { return WeightOf(*a) > WeightOf(*b); });
  std::vector<FindingInBlock> all;
  for (const DiagnosedBlock* diagnosed : blocks) {
    for (const Finding* finding : FindingsByWeight(*diagnosed)) {
      all.push_back({diagnosed, finding});
    }
  }
  return all;
}

std::vector<UnexplainedInBlock> UnexplainedByWeight(const Diagnosis& diagnosis) {
  std::vector<UnexplainedInBlock> all;
  for (const DiagnosedBlock& diagnosed : diagnosis.blocks) {
    for (const Unexplained& unexplained : diagnosed.diagnosis.unexplained) {
      all.push_back({&diagnosed, &unexplained});
    }
  }
  const auto weight = [](const UnexplainedInBlock& entry) {
    return entry.unexplained->share * entry.diagnosed->diagnosis.search.flexible_gain;
  };
  std::stable_sort(all.begin(), all.end(),
                   [&](const UnexplainedInBlock& a, const UnexplainedInBlock& b) {
                     return weight(a) > weight(b);
                   });
  return all;
}

bool IsLeft(const DiagnosedBlock& diagnosed, std::size_t channel) {
  const auto& left = diagnosed.diagnosis.unexplained;
  return std::any_of(left.begin(), left.end(), [&](const Unexplained& unexplained) {
    return unexplained.location.channel == channel;
  });
}

}  // namespace tera
