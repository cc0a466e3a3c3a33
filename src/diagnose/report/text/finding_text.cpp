#include "diagnose/report/text/finding_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "diagnose/report/text/wording.h"

namespace tera {
namespace {

constexpr int kPresentDigits = 4;
constexpr std::size_t kAllTold = 3;  ///< numbers of a mechanism
constexpr double kClear = 3;         ///< standard deviations
constexpr std::size_t kRivalsTold = 2;

/// The number that a mechanism cannot be without, where it is the first and only one, goes by the
/// mechanism's name.
bool GoesUnnamed(const Mechanism& mechanism, std::size_t index) {
  const auto required = std::count_if(mechanism.parameters.begin(), mechanism.parameters.end(),
                                      [](const EffectParameter& p) { return !p.otherwise; });
  return index == 0 && required == 1 && !mechanism.parameters[0].otherwise;
}

/// " instead of 0.05", where the simulation has the mechanism already.
std::string InsteadText(const Suspect& suspect, std::size_t index, const ReadableUnit& unit) {
  if (suspect.present.empty()) return "";
  return " instead of " +
         WithUnit(Significant(suspect.present[index] * unit.factor, kPresentDigits), unit);
}

/// " 0.18 ± 0.02, asymmetry 0.1 ± 0.05", or nothing.
std::string NumbersText(const Finding& finding) {
  const Suspect& suspect = *finding.term.suspect;
  std::vector<std::string> numbers;
  for (const FreeParameter& free : suspect.free) {
    const ParameterEstimate& estimate = finding.parameters[free.index];
    if (finding.term.IsHeld(free.index) || !IsTold(finding, free)) continue;
    const ReadableUnit unit = ReadableUnitOf(estimate);
    std::optional<double> sigma = estimate.sigma;
    if (sigma) *sigma *= unit.factor;
    const std::string number = WithUnit(WithSigma(estimate.value * unit.factor, sigma), unit) +
                               InsteadText(suspect, free.index, unit);
    numbers.push_back(GoesUnnamed(*suspect.mechanism, free.index)
                          ? number
                          : WithoutUnit(estimate.name) + " " + number);
  }
  return numbers.empty() ? "" : fmt::format(" {}", fmt::join(numbers, ", "));
}

}  // namespace

std::string NameAndNumbers(const Finding& finding) {
  return Spaced(finding.term.suspect->mechanism->id) + NumbersText(finding);
}

std::string MechanismText(const DiagnosedBlock& diagnosed, const Finding& finding) {
  const Suspect& suspect = *finding.term.suspect;
  const std::string& channel = diagnosed.block.channels[finding.location.channel].name;
  if (suspect.target == "base" || channel.find(suspect.target) != std::string::npos) {
    return NameAndNumbers(finding);
  }
  return fmt::format("{} of the {}{}", Spaced(suspect.mechanism->id), Spaced(suspect.target),
                     NumbersText(finding));
}

std::string RivalText(const Suspect& rival, const Suspect& found) {
  const std::string text = Spaced(rival.mechanism->id);
  if (rival.target != found.target) return text + " of the " + Spaced(rival.target);
  return rival.mechanism == found.mechanism ? text + " by its other numbers" : text;
}

std::vector<std::string> AlikeTexts(const Finding& finding) {
  std::vector<std::string> alike;
  for (const Suspect* rival : finding.evidence.rivals) {
    if (rival != finding.term.suspect) alike.push_back(RivalText(*rival, *finding.term.suspect));
  }
  return alike;
}

std::string EvidenceClause(const Finding& finding) {
  std::string chosen = ProbabilityText(finding.evidence.p);
  if (finding.evidence.together_p) {
    chosen += fmt::format(" alone, {} together with what it is beside",
                          ProbabilityText(*finding.evidence.together_p));
  }
  std::string text =
      fmt::format("chosen with {}, confirmed with {}", chosen, ProbabilityText(finding.held_out.p));
  const std::vector<std::string> alike = AlikeTexts(finding);
  std::vector<std::string> rejected;
  for (const Rival& rival : finding.evidence.rejected) {
    if (rejected.size() == kRivalsTold) break;
    rejected.push_back(fmt::format("{} ({})", RivalText(*rival.suspect, *finding.term.suspect),
                                   ProbabilityText(rival.p)));
  }
  if (!alike.empty()) text += fmt::format("; not told apart from: {}", fmt::join(alike, ", "));
  if (!rejected.empty()) text += fmt::format("; rivals rejected: {}", fmt::join(rejected, ", "));
  return text;
}

bool IsTold(const Finding& finding, const FreeParameter& free) {
  const Suspect& suspect = *finding.term.suspect;
  const ParameterEstimate& estimate = finding.parameters[free.index];
  if (suspect.free.size() <= kAllTold || !estimate.sigma) return true;
  const double without = suspect.present.empty()
                             ? suspect.mechanism->parameters[free.index].otherwise.value_or(0)
                             : suspect.present[free.index];
  return std::abs(estimate.value - without) > kClear * *estimate.sigma;
}

bool IsUnconfirmed(const DiagnosedBlock& diagnosed, std::size_t channel) {
  const std::vector<Finding>& unconfirmed = diagnosed.diagnosis.unconfirmed;
  return std::any_of(unconfirmed.begin(), unconfirmed.end(),
                     [&](const Finding& finding) { return finding.location.channel == channel; });
}

}  // namespace tera
