#include "diagnose/report/text/sentence.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "diagnose/diagnosis.h"
#include "diagnose/report/text/words.h"
#include "diagnose/search/fit/steady_gain.h"
#include "diagnose/search/fit/structure_fit.h"
#include "diagnose/tolerances/within_tolerance.h"

namespace tera {
namespace {

constexpr int kPresentDigits = 4;  ///< significant digits of a value that the scenario already has
/// A mechanism with at most this number of free parameters reports all of them.
constexpr std::size_t kFewNumbers = 3;
/// With more parameters, a parameter is reported beyond this number of standard deviations from its
/// default.
constexpr double kClearDeviations = 3;
constexpr std::size_t kMostRivalsNamed = 2;  ///< number of rejected rivals that are named

/// True if a parameter is written without its name, because it is the first and only parameter that
/// the mechanism requires.
bool GoesUnnamed(const Mechanism& mechanism, std::size_t index) {
  const auto required = std::count_if(mechanism.parameters.begin(), mechanism.parameters.end(),
                                      [](const EffectParameter& p) { return !p.otherwise; });
  return index == 0 && required == 1 && !mechanism.parameters[0].otherwise;
}

/// " instead of 0.05", if the scenario already has the mechanism.
std::string InsteadText(const Candidate& candidate, std::size_t index, const ReadableUnit& unit) {
  if (candidate.present.empty()) return "";
  return " instead of " +
         WithUnit(Significant(candidate.present[index] * unit.factor, kPresentDigits), unit);
}

}  // namespace

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
  return fmt::format("{}", fmt::join(numbers, ", "));
}

std::string NameAndNumbers(const Finding& finding) {
  const std::string numbers = NumbersText(finding);
  return Spaced(finding.term.candidate->mechanism->id) + (numbers.empty() ? "" : " ") + numbers;
}

std::string MechanismText(const DiagnosedBlock& diagnosed, const Finding& finding) {
  const Candidate& candidate = *finding.term.candidate;
  const std::string& channel = diagnosed.block.channels[finding.location.channel].name;
  const std::string text = NameAndNumbers(finding);
  if (candidate.target == "base" || channel.find(candidate.target) != std::string::npos) {
    return text;
  }
  const std::size_t name = candidate.mechanism->id.size();
  return fmt::format("{} of the {}{}", text.substr(0, name), Spaced(candidate.target),
                     text.substr(name));
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
  const double without = DefaultOf(candidate, free.index).value_or(0);
  return std::abs(estimate.value - without) > kClearDeviations * *estimate.sigma;
}

bool IsUnconfirmed(const DiagnosedBlock& diagnosed, std::size_t channel) {
  const std::vector<Finding>& unconfirmed = diagnosed.diagnosis.unconfirmed;
  return std::any_of(unconfirmed.begin(), unconfirmed.end(),
                     [&](const Finding& finding) { return finding.location.channel == channel; });
}

namespace {

constexpr double kSignificant = 0.05;  ///< a regime with a smaller p is stated without it

std::string ChannelText(const DiagnosedBlock& diagnosed, std::size_t channel) {
  return Capitalised(QuantityOf(diagnosed.block.channels[channel].name));
}

/// "41–63 s and 8 more intervals"; the interval with the largest error is named.
std::string WhenText(const DiagnosedBlock& diagnosed, const Location& location) {
  if (location.intervals.empty()) return "the whole recording";
  const Segment& worst = location.intervals[location.worst];
  const double from_s = diagnosed.block.time_s(worst.begin);
  const double to_s = diagnosed.block.time_s(worst.end);
  return IntervalsText(from_s, to_s, location.intervals.size() - 1);
}

/// Form of a curve in words. Words that its range already implies are left out.
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
      words.push_back("a step at " + Readable(shape.bend, unit));
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

/// True if a curve of this form differs from a constant only in a range of the variable.
bool HasRange(CurveForm form) {
  return form == CurveForm::kSaturating || form == CurveForm::kThreshold ||
         form == CurveForm::kLocal || form == CurveForm::kFree;
}

/// First regime of a location, as the end of a sentence "the error ..".
std::string DependenceText(const DiagnosedBlock& diagnosed, const Location& location) {
  if (location.regimes.empty()) return "depends on nothing that was recorded";
  const Regime& first = location.regimes.front();
  const std::string depends =
      first.is_share ? "is a share of the simulated value that depends" : "depends";
  std::string text = RegimeText(first, diagnosed, location.channel);
  std::vector<std::string> others;
  for (std::size_t r = 1; r < location.regimes.size(); ++r) {
    if (location.regimes[r].p > kSignificant) continue;
    const std::string name = VariableText(location.regimes[r].variable, diagnosed.block);
    if (name != VariableText(first.variable, diagnosed.block) &&
        std::find(others.begin(), others.end(), name) == others.end()) {
      others.push_back(name);
    }
  }
  if (!others.empty()) text += fmt::format(", and on {}", fmt::join(others, " and "));
  if (first.p <= kSignificant) return fmt::format("{} on {}", depends, text);
  const std::string surely =
      first.p < 1 ? ProbabilityText(first.p) : "which moves too slowly for a p";
  return fmt::format("{} most on {} ({})", depends, text, surely);
}

/// "0.6 deg/s at a noise of 0.2 deg/s".
std::string LeftText(double rmse, double noise, const std::string& si_unit) {
  return fmt::format("{} at a noise of {}", Readable(rmse, si_unit), Readable(noise, si_unit));
}

/// Residual of a fully explained channel, in words.
std::string ResidualText(const DiagnosedBlock& diagnosed, std::size_t channel) {
  if (IsLeft(diagnosed, channel)) return "";
  for (const ResidualVerdict& verdict : diagnosed.diagnosis.residual_verdicts) {
    if (verdict.channel != channel) continue;
    std::string text = " Left: " + LeftText(verdict.rmse, verdict.noise.rms(),
                                            diagnosed.block.channels[channel].unit);
    if (verdict.kind == ResidualVerdict::Kind::kUnknown) {
      text += ", of noise or error, which a recording without rest does not tell";
    }
    if (verdict.kind == ResidualVerdict::Kind::kOfFew) {
      text += fmt::format(", most of it in {} of {} manoeuvres", verdict.loud, verdict.manoeuvres);
    }
    if (!verdict.flexible_regressor_predicts) {
      text += ", and no flexible regressor that could tell whether there is more";
    }
    return text + ".";
  }
  return "";
}

std::string HeldOutText(const HeldOutError& error, const std::string& si_unit) {
  const std::string fall = "Held-out RMSE " + Change(error.rmse_before, error.rmse_after, si_unit);
  if (error.excess_removed > 0) {
    return fmt::format("{}, {} of the excess variance removed.", fall,
                       PercentText(error.excess_removed));
  }
  // The error is not larger than the noise, so there is no excess.
  if (error.rmse_after < error.rmse_before) return fall + ".";
  // Many manoeuvres are likelier with the finding, and this confirmed it.
  return fmt::format("{}, none of the excess variance removed{}.", fall,
                     error.p > kSignificant ? "" : ", for a few manoeuvres outweigh the rest");
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
  if (IsOfChance(diagnosed.block, *finding.term.candidate)) {
    return fmt::format(
        "{}, {}: {} ({}). Which commands were lost was read from the recording, for no simulation "
        "predicts it. With the rate held there, RMSE {}.",
        ChannelText(diagnosed, channel), WhenText(diagnosed, finding.location),
        MechanismText(diagnosed, finding), ProbabilityText(finding.evidence.p),
        Change(finding.held_out.rmse_before, finding.held_out.rmse_after,
               diagnosed.block.channels[channel].unit));
  }
  return fmt::format(
      "{}, {}; the error {}: {} ({}). {}{}", ChannelText(diagnosed, channel),
      WhenText(diagnosed, finding.location), DependenceText(diagnosed, finding.location),
      MechanismText(diagnosed, finding), EvidenceClause(finding),
      HeldOutText(finding.held_out, diagnosed.block.channels[finding.held_out.channel].unit),
      ResidualText(diagnosed, channel));
}

std::string SentenceOf(const DiagnosedBlock& diagnosed, const Unexplained& unexplained) {
  const std::size_t channel = unexplained.location.channel;
  const std::string left =
      LeftText(unexplained.rmse, unexplained.noise, diagnosed.block.channels[channel].unit);
  return fmt::format(
      "{}, {}; the error {}: no known mechanism explains it ({}). Left: {}.",
      ChannelText(diagnosed, channel), WhenText(diagnosed, unexplained.location),
      DependenceText(diagnosed, unexplained.location),
      unexplained.p ? fmt::format("{}; {} of what a flexible regressor could explain",
                                  ProbabilityText(*unexplained.p), PercentText(unexplained.share))
                    : std::string("nor does a flexible regressor"),
      left);
}

std::string SentenceOf(const ReplayBlock& block, const Learned& learned) {
  const Channel& channel = block.channels[learned.channel];
  return fmt::format(
      "{}: effects.yaml has the unexplained error as learned, a function of {}: held-out RMSE {} "
      "in the replay.",
      Capitalised(QuantityOf(channel.name)), VariableText(learned.effect.variable.name, block),
      Change(learned.rmse_before, learned.rmse_after, channel.unit));
}

std::string SentenceOfUnconfirmed(const DiagnosedBlock& diagnosed, const Finding& finding) {
  const HeldOutError& error = finding.held_out;
  if (finding.is_confirmed) {
    return fmt::format(
        "{}: {} was chosen ({}) and is not confirmed: the number is at the end of its range, or "
        "the "
        "recording does not determine it.",
        ChannelText(diagnosed, finding.location.channel), MechanismText(diagnosed, finding),
        ProbabilityText(finding.evidence.p));
  }
  std::string why = ProbabilityText(error.p);
  if (error.rmse_after >= error.rmse_before) {
    why = "its error there is " + Change(error.rmse_before, error.rmse_after,
                                         diagnosed.block.channels[finding.held_out.channel].unit);
  } else if (error.p <= kConfirmedP) {
    why = "too few of them gain clearly";
  }
  return fmt::format("{}: {} was chosen ({}) and is not confirmed on manoeuvres kept back ({}).",
                     ChannelText(diagnosed, finding.location.channel),
                     MechanismText(diagnosed, finding), ProbabilityText(finding.evidence.p), why);
}

std::string SentenceOfExpected(const DiagnosedBlock& diagnosed, const Finding& finding) {
  std::string why = "is within tolerance";
  const std::vector<const Candidate*>& rivals = finding.evidence.expected_rivals;
  if (IsExplainedAsExpected(finding)) {
    why = fmt::format("{} within its tolerance explains as well",
                      RivalText(*rivals.front(), *finding.term.candidate));
  } else if (!IsOfPracticalSize(finding)) {
    const auto& expected = finding.as_expected;
    why = expected && expected->rmse < finding.held_out.rmse_before
              ? "takes little that delays, lags, bands and gains within their tolerances would not"
              : "changes less than a factor within its tolerance does";
  }
  return fmt::format("{}: {}, which {}.", ChannelText(diagnosed, finding.location.channel),
                     MechanismText(diagnosed, finding), why);
}

std::string SentenceOfProxy(const DiagnosedBlock& diagnosed, const Finding& finding) {
  const double removed = finding.held_out.excess_removed;
  const std::string share =
      removed > 0 ? fmt::format(" ({} of the excess variance removed)", PercentText(removed)) : "";
  const std::vector<std::string> alike = AlikeTexts(finding);
  const std::string others = alike.empty() ? "" : fmt::format(" or {}", fmt::join(alike, " or "));
  return fmt::format("{}: {}{} comes nearest to what is unexplained and is no name for it{}.",
                     ChannelText(diagnosed, finding.location.channel),
                     MechanismText(diagnosed, finding), others, share);
}

std::string SentenceOfUntestable(const DiagnosedBlock& diagnosed) {
  std::vector<std::string> channels;
  for (const Channel& channel : diagnosed.block.channels)
    channels.push_back(QuantityOf(channel.name));
  if (diagnosed.diagnosis.out_of_time) {
    return fmt::format("{}: not judged, for the time was over.", Capitalised(Listed(channels)));
  }
  return fmt::format("{}: not judged, for {} in too few manoeuvres of the recording.",
                     Capitalised(Listed(channels)),
                     HasLever(diagnosed.block) ? "its lever moves"
                     : channels.size() == 1    ? "it is moved"
                                               : "they are moved");
}

std::string SentenceOf(const MissingInput& missing) {
  const char* const how = missing.is_one_sided
                              ? "against its lever, which the recording has to one side alone"
                              : "while its lever rests";
  return fmt::format(
      "{:.0f} % of the motion of the {} is {}: input is missing. Mend that first; of its lever, "
      "valve and drive nothing was searched for.",
      100 * missing.share, Spaced(missing.axis), how);
}

}  // namespace tera
