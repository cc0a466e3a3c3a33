#include "diagnose/report/text/finding_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "diagnose/report/text/wording.h"

namespace tera {
namespace {

constexpr int kPresentDigits = 4;  ///< of a number that the simulation has already
/// Free numbers of a mechanism up to which all are reported.
constexpr std::size_t kFewNumbers = 3;
/// Standard deviations by which a number of many must differ from its default to be reported.
constexpr double kClearDeviations = 3;
constexpr std::size_t kMostRivalsNamed = 2;  ///< of those that were rejected

/// Whether a number is written without its name: it is the first and only one that a mechanism
/// requires, so that the mechanism's name is enough.
bool GoesUnnamed(const Mechanism& mechanism, std::size_t index) {
  const auto required = std::count_if(mechanism.parameters.begin(), mechanism.parameters.end(),
                                      [](const EffectParameter& p) { return !p.otherwise; });
  return index == 0 && required == 1 && !mechanism.parameters[0].otherwise;
}

/// " instead of 0.05", where the simulation has the mechanism already.
std::string InsteadText(const Candidate& candidate, std::size_t index, const ReadableUnit& unit) {
  if (candidate.present.empty()) return "";
  return " instead of " +
         WithUnit(Significant(candidate.present[index] * unit.factor, kPresentDigits), unit);
}

/// " 0.18 ± 0.02, asymmetry 0.1 ± 0.05"; empty where no number is reported.
std::string NumbersText(const Finding& finding) {
  const Candidate& candidate = *finding.term.candidate;
  std::vector<std::string> numbers;
  for (const FreeParameter& free : candidate.free) {
    const ParameterEstimate& estimate = finding.parameters[free.index];
    if (finding.term.IsHeld(free.index) || !IsReported(finding, free)) continue;
    const ReadableUnit unit = ReadableUnitOf(estimate);
    std::optional<double> sigma = estimate.sigma;
    if (sigma) *sigma *= unit.factor;
    const std::string number = WithUnit(WithSigma(estimate.value * unit.factor, sigma), unit) +
                               InsteadText(candidate, free.index, unit);
    numbers.push_back(GoesUnnamed(*candidate.mechanism, free.index)
                          ? number
                          : WithoutUnit(estimate.name) + " " + number);
  }
  return numbers.empty() ? "" : fmt::format(" {}", fmt::join(numbers, ", "));
}

}  // namespace

std::string NameAndNumbers(const Finding& finding) {
  return Spaced(finding.term.candidate->mechanism->id) + NumbersText(finding);
}

std::string MechanismText(const DiagnosedBlock& diagnosed, const Finding& finding) {
  const Candidate& candidate = *finding.term.candidate;
  const std::string& channel = diagnosed.block.channels[finding.location.channel].name;
  if (candidate.target == "base" || channel.find(candidate.target) != std::string::npos) {
    return NameAndNumbers(finding);
  }
  return fmt::format("{} of the {}{}", Spaced(candidate.mechanism->id), Spaced(candidate.target),
                     NumbersText(finding));
}

std::string RivalText(const Candidate& rival, const Candidate& found) {
  const std::string text = Spaced(rival.mechanism->id);
  if (rival.target != found.target) return text + " of the " + Spaced(rival.target);
  return rival.mechanism == found.mechanism ? text + " by its other numbers" : text;
}

std::vector<std::string> AlikeTexts(const Finding& finding) {
  std::vector<std::string> alike;
  for (const Candidate* rival : finding.evidence.rivals) {
    if (rival != finding.term.candidate)
      alike.push_back(RivalText(*rival, *finding.term.candidate));
  }
  return alike;
}

std::string EvidenceClause(const Finding& finding) {
  std::string chosen = ProbabilityText(finding.evidence.p);
  if (finding.evidence.joint_p) {
    chosen += fmt::format(" alone, {} together with what it is beside",
                          ProbabilityText(*finding.evidence.joint_p));
  }
  std::string text =
      fmt::format("chosen with {}, confirmed with {}", chosen, ProbabilityText(finding.held_out.p));
  const std::vector<std::string> alike = AlikeTexts(finding);
  std::vector<std::string> rejected;
  for (const Rival& rival : finding.evidence.rejected) {
    if (rejected.size() == kMostRivalsNamed) break;
    rejected.push_back(fmt::format("{} ({})", RivalText(*rival.candidate, *finding.term.candidate),
                                   ProbabilityText(rival.p)));
  }
  if (!alike.empty()) text += fmt::format("; not told apart from: {}", fmt::join(alike, ", "));
  if (!rejected.empty()) text += fmt::format("; rivals rejected: {}", fmt::join(rejected, ", "));
  return text;
}

bool IsReported(const Finding& finding, const FreeParameter& free) {
  const Candidate& candidate = *finding.term.candidate;
  const ParameterEstimate& estimate = finding.parameters[free.index];
  if (candidate.free.size() <= kFewNumbers || !estimate.sigma) return true;
  const double without = candidate.present.empty()
                             ? candidate.mechanism->parameters[free.index].otherwise.value_or(0)
                             : candidate.present[free.index];
  return std::abs(estimate.value - without) > kClearDeviations * *estimate.sigma;
}

bool IsUnconfirmed(const DiagnosedBlock& diagnosed, std::size_t channel) {
  const std::vector<Finding>& unconfirmed = diagnosed.diagnosis.unconfirmed;
  return std::any_of(unconfirmed.begin(), unconfirmed.end(),
                     [&](const Finding& finding) { return finding.location.channel == channel; });
}

}  // namespace tera
