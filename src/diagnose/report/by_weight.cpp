#include "diagnose/report/by_weight.h"

#include <algorithm>

namespace tera {
namespace {

/// Shares are of what the free member of the own block gains.
template <typename Entry, typename Share>
void SortByWeight(std::vector<Entry>* entries, const Share& share) {
  const auto weight = [&](const Entry& entry) {
    return share(entry) * entry.diagnosed->diagnosis.search.free_gain;
  };
  std::stable_sort(entries->begin(), entries->end(),
                   [&](const Entry& a, const Entry& b) { return weight(a) > weight(b); });
}

}  // namespace

std::vector<FindingInBlock> FindingsByWeight(const Diagnosis& diagnosis) {
  std::vector<FindingInBlock> all;
  for (const DiagnosedBlock& diagnosed : diagnosis.blocks) {
    for (const Finding& finding : diagnosed.diagnosis.findings) {
      all.push_back({&diagnosed, &finding});
    }
  }
  SortByWeight(&all, [](const FindingInBlock& entry) { return entry.finding->evidence.share; });
  return all;
}

std::vector<const Finding*> FindingsByWeight(const DiagnosedBlock& diagnosed) {
  std::vector<const Finding*> all;
  for (const Finding& finding : diagnosed.diagnosis.findings) all.push_back(&finding);
  std::stable_sort(all.begin(), all.end(), [](const Finding* a, const Finding* b) {
    return a->evidence.share > b->evidence.share;
  });
  return all;
}

std::vector<UnexplainedInBlock> UnexplainedByWeight(const Diagnosis& diagnosis) {
  std::vector<UnexplainedInBlock> all;
  for (const DiagnosedBlock& diagnosed : diagnosis.blocks) {
    for (const Unexplained& unexplained : diagnosed.diagnosis.unexplained) {
      all.push_back({&diagnosed, &unexplained});
    }
  }
  SortByWeight(&all, [](const UnexplainedInBlock& entry) { return entry.unexplained->share; });
  return all;
}

bool IsLeft(const DiagnosedBlock& diagnosed, std::size_t channel) {
  const auto& left = diagnosed.diagnosis.unexplained;
  return std::any_of(left.begin(), left.end(), [&](const Unexplained& unexplained) {
    return unexplained.location.channel == channel;
  });
}

}  // namespace tera
