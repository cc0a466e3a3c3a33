#include "diagnose/tolerances/within_tolerance.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "diagnose/statistics/series/robust.h"
#include "diagnose/tolerances/default_tolerances.h"

namespace tera {
namespace {

/// Expected deviation of a candidate's parameter. None without a stated or default tolerance.
std::optional<Expected> ExpectedOf(const Tolerances& stated, const Candidate& candidate,
                                   const FreeParameter& free) {
  const std::size_t parameter = free.index;
  const std::string_view id = candidate.mechanism->id;
  const std::string_view name = candidate.mechanism->parameters[parameter].name;
  std::optional<Expected> expected = free.expected;
  if (const DefaultTolerance* known = DefaultToleranceOf(candidate.target, id, name)) {
    expected = {known->neutral, known->half_width, known->neutral};
  }
  for (const Tolerance& one : stated) {
    const bool is_this = one.target == candidate.target && one.mechanism->id == id &&
                         one.mechanism->parameters[one.parameter].name == name;
    if (!is_this) continue;
    if (!expected) expected = {candidate.mechanism->parameters[parameter].otherwise.value_or(0), 0};
    expected->half_width = one.half_width;
  }
  if (expected && !candidate.present.empty()) expected->value = candidate.present[parameter];
  return expected;
}

/// Factor on the interval of the lever log by which a tolerance widens: 1 for the period of an
/// input reader, 0.5 for delays and lags of commands, else 0.
double LateByLever(const Candidate& candidate, const FreeParameter& free) {
  const std::string_view id = candidate.mechanism->id;
  const std::string_view name = candidate.mechanism->parameters[free.index].name;
  if (id == "input_hold" && name == "period_s") return 1;
  const bool is_delay = (id == "command_delay" && name == "delay_s") ||
                        (id == "actuator_lag" && name == "time_s") ||
                        (id == "drive_friction" && name == "time_s");
  return is_delay ? 0.5 : 0;
}

/// True if a finding is within tolerance regardless of its parameters.
bool IsExpectedAnyhow(const Finding& finding) {
  return !IsOfPracticalSize(finding) || IsExplainedAsExpected(finding);
}

void RejectExpectedRivals(TermEvidence* evidence) {
  const auto& expected = evidence->expected_rivals;
  std::erase_if(evidence->rivals, [&](const Candidate* rival) {
    return std::find(expected.begin(), expected.end(), rival) != expected.end();
  });
}

}  // namespace

void StateTolerances(const Tolerances& stated, std::vector<ReplayBlock>* blocks,
                     double lever_interval_s) {
  for (ReplayBlock& block : *blocks) {
    for (Candidate& candidate : block.candidates) {
      for (FreeParameter& free : candidate.free) {
        free.expected = ExpectedOf(stated, candidate, free);
        if (!free.expected) continue;
        free.expected->half_width += LateByLever(candidate, free) * lever_interval_s;
      }
    }
  }
}

bool IsOfPracticalSize(const Finding& finding) {
  if (finding.tolerated == 0) return true;
  const HeldOutError& error = finding.held_out;
  const ErrorAsExpected none{error.rmse_before, 0};
  const ErrorAsExpected expected = finding.as_expected.value_or(none);
  const double before = std::min(error.rmse_before, expected.rmse);
  const double taken = std::pow(before, 2) - std::pow(error.rmse_after, 2);
  const double least = taken - kOneSided95 * expected.taken_sigma;
  return least > 0 && std::sqrt(least) >= finding.tolerated;
}

bool IsExplainedAsExpected(const Finding& finding) {
  const bool has_no_size = finding.tolerated == 0 || !finding.as_expected;
  return !finding.evidence.expected_rivals.empty() && (has_no_size || !IsOfPracticalSize(finding));
}

bool IsBeyondTolerance(const Finding& finding) {
  if (IsExpectedAnyhow(finding)) return false;
  bool is_stated = false;
  for (const FreeParameter& free : finding.term.candidate->free) {
    if (!free.expected) continue;
    is_stated = true;
    const ParameterEstimate& estimate = finding.parameters[free.index];
    if (!estimate.sigma || finding.term.IsHeld(free.index)) continue;
    const double off = std::abs(estimate.value - free.expected->value);
    const double sigma = estimate.effect_sigma.value_or(*estimate.sigma);
    if (off - kOneSided95 * sigma > free.expected->half_width) return true;
  }
  return !is_stated;
}

bool IsWithinTolerance(const Finding& finding) {
  if (IsExpectedAnyhow(finding)) return true;
  const auto& free = finding.term.candidate->free;
  return !IsBeyondTolerance(finding) &&
         std::all_of(free.begin(), free.end(), [&](const FreeParameter& one) {
           const ParameterEstimate& estimate = finding.parameters[one.index];
           const bool is_known = estimate.sigma && !finding.term.IsHeld(one.index);
           return !one.expected || is_known ||
                  std::abs(estimate.value - one.expected->value) <= one.expected->half_width;
         });
}

void MoveExpected(BlockDiagnosis* diagnosis) {
  std::vector<Finding>& findings = diagnosis->findings;
  const auto other = std::stable_partition(findings.begin(), findings.end(), IsBeyondTolerance);
  for (auto finding = other; finding != findings.end(); ++finding) {
    (IsWithinTolerance(*finding) ? diagnosis->within_tolerance : diagnosis->unconfirmed)
        .push_back(std::move(*finding));
  }
  findings.erase(other, findings.end());
  for (Finding& finding : findings) RejectExpectedRivals(&finding.evidence);
}

}  // namespace tera
