#include "diagnose/report/sentence.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "diagnose/report/by_weight.h"
#include "diagnose/report/wording.h"

namespace tera {
namespace {

constexpr double kSignificant = 0.05;
constexpr std::size_t kRivalsTold = 2;
constexpr int kPresentDigits = 4;
constexpr std::size_t kAllTold = 3;  ///< numbers of a mechanism
constexpr double kClear = 3;         ///< standard deviations

std::string ChannelText(const DiagnosedBlock& diagnosed, std::size_t channel) {
  return Capitalised(QuantityOf(diagnosed.block.channels[channel].name));
}

/// "41–63 s and 8 more intervals".
std::string IntervalsText(const DiagnosedBlock& diagnosed, const std::vector<Segment>& intervals) {
  if (intervals.empty()) return "the whole recording";
  const Segment& longest =
      *std::max_element(intervals.begin(), intervals.end(),
                        [](const Segment& a, const Segment& b) { return a.size() < b.size(); });
  const double period_s = diagnosed.block.period_s();
  const double from_s = static_cast<double>(longest.begin) * period_s;
  const double to_s = static_cast<double>(longest.end) * period_s;
  std::string text =
      fmt::format("{}–{} s", TimeText(from_s, to_s - from_s), TimeText(to_s, to_s - from_s));
  const std::size_t more = intervals.size() - 1;
  if (more > 0) text += fmt::format(" and {} more interval{}", more, more == 1 ? "" : "s");
  return text;
}

/// What a curve looks like, as far as its range does not say it.
std::string FormText(const CurveShape& shape, const ReadableUnit& unit) {
  std::vector<std::string> words;
  switch (shape.form) {
    case CurveForm::kLinear:
      words.push_back("in proportion");
      break;
    case CurveForm::kSmooth:
      words.push_back("curved");
      break;
    case CurveForm::kSaturating:
      words.push_back("constant beyond");
      break;
    case CurveForm::kThreshold:
      words.push_back("growing");
      break;
    case CurveForm::kStep:
      words.push_back("a step at " + WithUnit(Significant(shape.bend * unit.factor, 2), unit));
      break;
    case CurveForm::kPeriodic:
      words.push_back(shape.bend == 1 ? "once a turn"
                                      : fmt::format("{:.0f} times a turn", shape.bend));
      break;
    case CurveForm::kNone:
      words.push_back("without a clear shape");
      break;
    case CurveForm::kLocal:
    case CurveForm::kLevels:
    case CurveForm::kFree:
      break;
  }
  if (shape.parity == CurveParity::kOdd || shape.parity == CurveParity::kEven) {
    words.push_back(std::string(NameOf(shape.parity)));
  }
  return words.empty() ? "" : fmt::format(", {}", fmt::join(words, ", "));
}

/// Whether a form lives in a part of what was visited only.
bool HasRange(CurveForm form) {
  return form == CurveForm::kSaturating || form == CurveForm::kThreshold ||
         form == CurveForm::kLocal || form == CurveForm::kFree;
}

/// The first regime of a location, as the end of "the error ..".
std::string DependenceText(const DiagnosedBlock& diagnosed, const Location& location) {
  if (location.regimes.empty()) return "depends on nothing that was recorded";
  const Regime& first = location.regimes.front();
  std::string text = RegimeText(first, diagnosed, location.channel);
  if (first.p > kSignificant)
    return fmt::format("depends most on {} ({})", text, ProbabilityText(first.p));
  std::vector<std::string> others;
  for (std::size_t r = 1; r < location.regimes.size(); ++r) {
    if (location.regimes[r].p > kSignificant) continue;
    others.push_back(VariableText(location.regimes[r].variable, diagnosed.block));
  }
  if (!others.empty()) text += fmt::format(", and on {}", fmt::join(others, " and "));
  return "depends on " + text;
}

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

/// Whether a number is worth telling: of few all, of many those that are clearly not as they would
/// be without the finding.
bool IsTold(const Suspect& suspect, const FreeParameter& free, const ParameterEstimate& estimate) {
  if (suspect.free.size() <= kAllTold || !estimate.sigma) return true;
  const double without = suspect.present.empty()
                             ? suspect.mechanism->parameters[free.index].otherwise.value_or(0)
                             : suspect.present[free.index];
  return std::abs(estimate.value - without) > kClear * *estimate.sigma;
}

/// "dead band 0.18 ± 0.02, asymmetry 0.1 ± 0.05".
std::string MechanismText(const DiagnosedBlock& diagnosed, const Finding& finding) {
  const Suspect& suspect = *finding.term.suspect;
  std::string text = Spaced(suspect.mechanism->id);
  const std::string& channel = diagnosed.block.channels[finding.location.channel].name;
  if (suspect.target != "base" && channel.find(suspect.target) == std::string::npos) {
    text += " of the " + Spaced(suspect.target);
  }
  std::vector<std::string> numbers;
  for (const FreeParameter& free : suspect.free) {
    const ParameterEstimate& estimate = finding.parameters[free.index];
    if (!IsTold(suspect, free, estimate)) continue;
    const ReadableUnit unit = ReadableUnitOf(estimate);
    std::optional<double> sigma = estimate.sigma;
    if (sigma) *sigma *= unit.factor;
    const std::string number = WithUnit(WithSigma(estimate.value * unit.factor, sigma), unit) +
                               InsteadText(suspect, free.index, unit);
    numbers.push_back(GoesUnnamed(*suspect.mechanism, free.index)
                          ? number
                          : WithoutUnit(estimate.name) + " " + number);
  }
  return numbers.empty() ? text : fmt::format("{} {}", text, fmt::join(numbers, ", "));
}

/// Suspects that gain most alone but do not stand in this one's place.
std::vector<std::string> RejectedRivals(const DiagnosedBlock& diagnosed, const Finding& finding) {
  const SearchResult& search = diagnosed.diagnosis.search;
  std::set<const Suspect*> others(finding.evidence.rivals.begin(), finding.evidence.rivals.end());
  for (const Term& term : search.found.terms) others.insert(term.suspect);
  std::vector<SingleEvidence> singles = search.singles;
  std::stable_sort(singles.begin(), singles.end(),
                   [](const auto& a, const auto& b) { return a.gain > b.gain; });
  std::vector<std::string> names;
  for (const SingleEvidence& single : singles) {
    if (names.size() == kRivalsTold) break;
    if (others.contains(single.suspect) || single.held_out_gain <= 0) continue;
    names.push_back(Spaced(single.suspect->mechanism->id));
  }
  return names;
}

std::string ConfidenceClause(const DiagnosedBlock& diagnosed, const Finding& finding) {
  std::string text = "confidence " + ConfidenceText(finding.confidence);
  std::vector<std::string> alike;
  for (const Suspect* rival : finding.evidence.rivals) {
    if (rival != finding.term.suspect) alike.push_back(Spaced(rival->mechanism->id));
  }
  if (!alike.empty()) text += fmt::format("; not told apart from: {}", fmt::join(alike, ", "));
  const auto rejected = RejectedRivals(diagnosed, finding);
  if (!rejected.empty()) text += fmt::format("; rivals rejected: {}", fmt::join(rejected, ", "));
  return text;
}

std::string HeldOutText(const HeldOutError& error, const std::string& si_unit) {
  const ReadableUnit unit = ReadableUnitOf(si_unit);
  const std::string removed = error.excess_removed > 0
                                  ? PercentText(error.excess_removed) + " of the excess variance"
                                  : "none of the excess variance";
  return fmt::format("Held-out RMSE {} → {}, {} removed.",
                     Significant(error.rmse_before * unit.factor, 2),
                     WithUnit(Significant(error.rmse_after * unit.factor, 2), unit), removed);
}

/// "a, b and c".
std::string Listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  }
  return text;
}

}  // namespace

std::string RegimeText(const Regime& regime, const DiagnosedBlock& diagnosed, std::size_t channel) {
  const std::string name = VariableText(regime.variable, diagnosed.block);
  const ReadableUnit unit =
      ReadableUnitOf(UnitOfVariable(regime.variable, diagnosed.block.channels[channel].unit));
  const CurveShape& shape = regime.shape;
  const std::string form = FormText(shape, unit);
  if (!HasRange(shape.form)) return name + form;
  const std::string low = Significant(shape.low * unit.factor, 2);
  const std::string high = Significant(shape.high * unit.factor, 2);
  if (shape.low < 0 && shape.low == -shape.high) {
    return fmt::format("|{}| {} {}{}", name, shape.outside ? '>' : '<', WithUnit(high, unit), form);
  }
  return fmt::format("{} {} {} {} {}{}", name, shape.outside ? "outside" : "from", low,
                     shape.outside ? "and" : "to", WithUnit(high, unit), form);
}

std::string SentenceOf(const DiagnosedBlock& diagnosed, const Finding& finding) {
  const std::size_t channel = finding.location.channel;
  return fmt::format(
      "{}, {}; the error {}: {} ({}). {}{}", ChannelText(diagnosed, channel),
      IntervalsText(diagnosed, finding.location.intervals),
      DependenceText(diagnosed, finding.location), MechanismText(diagnosed, finding),
      ConfidenceClause(diagnosed, finding),
      HeldOutText(finding.held_out, diagnosed.block.channels[finding.held_out.channel].unit),
      IsLeft(diagnosed, channel) ? "" : " Nothing left.");
}

std::string SentenceOf(const DiagnosedBlock& diagnosed, const Unexplained& unexplained) {
  return fmt::format(
      "{}, {}; the error {}: no known mechanism explains it ({}; {} of what a free "
      "curve could explain).",
      ChannelText(diagnosed, unexplained.location.channel),
      IntervalsText(diagnosed, unexplained.location.intervals),
      DependenceText(diagnosed, unexplained.location), ProbabilityText(unexplained.p),
      PercentText(unexplained.share));
}

std::string SentenceOfNothing(const Diagnosis& diagnosis) {
  std::vector<std::string> channels;
  std::size_t suspects = 0, unseen = 0;
  for (const DiagnosedBlock& diagnosed : diagnosis.blocks) {
    for (const Channel& channel : diagnosed.block.channels) {
      channels.push_back(QuantityOf(channel.name));
    }
    suspects += diagnosed.diagnosis.detectability.size();
    for (const Detectability& one : diagnosed.diagnosis.detectability)
      unseen += one.smallest ? 0 : 1;
  }
  if (channels.empty()) return "Nothing compared: no channel of the recording can be replayed.";
  std::string text = fmt::format("Nothing found: {} agree{} with the simulation within the noise.",
                                 Listed(channels), channels.size() == 1 ? "s" : "");
  if (unseen > 0) {
    text += fmt::format(" Of {} mechanisms looked for, {} could not have been seen at any size.",
                        suspects, unseen);
  }
  return text;
}

std::vector<std::string> SentencesOf(const Diagnosis& diagnosis) {
  std::vector<std::string> sentences;
  for (const auto& [diagnosed, finding] : FindingsByWeight(diagnosis)) {
    sentences.push_back(SentenceOf(*diagnosed, *finding));
  }
  for (const auto& [diagnosed, unexplained] : UnexplainedByWeight(diagnosis)) {
    sentences.push_back(SentenceOf(*diagnosed, *unexplained));
  }
  if (sentences.empty()) sentences.push_back(SentenceOfNothing(diagnosis));
  return sentences;
}

}  // namespace tera
