#include "diagnose/report/text/ranking.h"

#include <algorithm>
#include <cmath>

namespace tera {
namespace {

/// Share of the mean square of its channel's error on FINAL that a finding removes.
double RemovedShare(const DiagnosedBlock& diagnosed, const Finding& finding) {
  const HeldOutError& error = finding.held_out;
  double at_first = 0;
  for (const HeldOutError& all : diagnosed.diagnosis.confirmed) {
    if (all.channel == error.channel) at_first = all.rmse_before;
  }
  const double removed = std::pow(error.rmse_before, 2) - std::pow(error.rmse_after, 2);
  return at_first > 0 ? removed / (at_first * at_first) : removed;
}

/// Gain in log-likelihood of a block's findings, each over the structure without it.
double GainOf(const DiagnosedBlock& diagnosed) {
  double share = 0;
  for (const Finding& finding : diagnosed.diagnosis.findings) share += finding.evidence.share;
  return share * diagnosed.diagnosis.search.flexible_gain;
}

}  // namespace

std::vector<const Finding*> RankedFindings(const DiagnosedBlock& diagnosed) {
  std::vector<const Finding*> all;
  for (const Finding& finding : diagnosed.diagnosis.findings) all.push_back(&finding);
  std::stable_sort(all.begin(), all.end(), [&](const Finding* a, const Finding* b) {
    return RemovedShare(diagnosed, *a) > RemovedShare(diagnosed, *b);
  });
  return all;
}

std::vector<FindingInBlock> RankedFindings(const Diagnosis& diagnosis) {
  std::vector<const DiagnosedBlock*> blocks;
  for (const DiagnosedBlock& diagnosed : diagnosis.blocks) blocks.push_back(&diagnosed);
  std::stable_sort(
      blocks.begin(), blocks.end(),
      [](const DiagnosedBlock* a, const DiagnosedBlock* b) { return GainOf(*a) > GainOf(*b); });
  std::vector<FindingInBlock> all;
  for (const DiagnosedBlock* diagnosed : blocks) {
    for (const Finding* finding : RankedFindings(*diagnosed)) {
      all.push_back({diagnosed, finding});
    }
  }
  return all;
}

std::vector<UnexplainedInBlock> RankedUnexplained(const Diagnosis& diagnosis) {
  std::vector<UnexplainedInBlock> all;
  for (const DiagnosedBlock& diagnosed : diagnosis.blocks) {
    for (const Unexplained& unexplained : diagnosed.diagnosis.unexplained) {
      all.push_back({&diagnosed, &unexplained});
    }
  }
  const auto gain = [](const UnexplainedInBlock& entry) {
    return entry.unexplained->share * entry.diagnosed->diagnosis.search.flexible_gain;
  };
  std::stable_sort(
      all.begin(), all.end(),
      [&](const UnexplainedInBlock& a, const UnexplainedInBlock& b) { return gain(a) > gain(b); });
  return all;
}

bool IsLeft(const DiagnosedBlock& diagnosed, std::size_t channel) {
  const auto& left = diagnosed.diagnosis.unexplained;
  return std::any_of(left.begin(), left.end(), [&](const Unexplained& unexplained) {
    return unexplained.location.channel == channel;
  });
}

}  // namespace tera
