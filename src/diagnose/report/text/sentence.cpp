#include "diagnose/report/text/sentence.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "diagnose/report/text/clock_text.h"
#include "diagnose/report/text/confirmation_text.h"
#include "diagnose/report/text/finding_text.h"
#include "diagnose/report/text/next_manoeuvre_text.h"
#include "diagnose/report/text/perception_text.h"
#include "diagnose/report/text/proposal_text.h"
#include "diagnose/report/text/ranking.h"
#include "diagnose/report/text/sensor_text.h"
#include "diagnose/report/text/wording.h"
#include "diagnose/search/fit/steady_gain.h"
#include "diagnose/tolerances/within_tolerance.h"

namespace tera {
namespace {

constexpr double kSignificant = 0.05;  ///< p of a regime up to which it is stated without its p

std::string ChannelText(const DiagnosedBlock& diagnosed, std::size_t channel) {
  return Capitalised(QuantityOf(diagnosed.block.channels[channel].name));
}

/// "41–63 s and 8 more intervals", the one with the most error first.
std::string WhenText(const DiagnosedBlock& diagnosed, const Location& location) {
  if (location.intervals.empty()) return "the whole recording";
  const Segment& worst = location.intervals[location.worst];
  const double from_s = diagnosed.block.time_s(worst.begin);
  const double to_s = diagnosed.block.time_s(worst.end);
  return IntervalsText(from_s, to_s, location.intervals.size() - 1);
}

/// The form of a curve in words, as far as its range does not say it.
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

/// Whether a curve of this form differs from a constant only in a range of the variable.
bool HasRange(CurveForm form) {
  return form == CurveForm::kSaturating || form == CurveForm::kThreshold ||
         form == CurveForm::kLocal || form == CurveForm::kFree;
}

/// The first regime of a location, as the end of "the error ..".
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
  const ReadableUnit unit = ReadableUnitOf(si_unit);
  return fmt::format("{} at a noise of {}", WithUnit(Significant(rmse * unit.factor, 2), unit),
                     WithUnit(Significant(noise * unit.factor, 2), unit));
}

/// The residual of a channel of which nothing is unexplained, in words.
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

/// "1.6 → 0.20 deg/s"
std::string RmseText(const HeldOutError& error, const std::string& si_unit) {
  const ReadableUnit unit = ReadableUnitOf(si_unit);
  return fmt::format("{} → {}", Significant(error.rmse_before * unit.factor, 2),
                     WithUnit(Significant(error.rmse_after * unit.factor, 2), unit));
}

std::string HeldOutText(const HeldOutError& error, const std::string& si_unit) {
  const std::string fall = "Held-out RMSE " + RmseText(error, si_unit);
  if (error.excess_removed > 0) {
    return fmt::format("{}, {} of the excess variance removed.", fall,
                       PercentText(error.excess_removed));
  }
  // The error is no louder than the noise, so that there is no excess.
  if (error.rmse_after < error.rmse_before) return fall + ".";
  // The finding was confirmed by the number of manoeuvres that are likelier with it.
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
        RmseText(finding.held_out, diagnosed.block.channels[channel].unit));
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
    why = "its error there is " +
          RmseText(error, diagnosed.block.channels[finding.held_out.channel].unit);
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

std::string SentenceOfNothing(const Diagnosis& diagnosis) {
  std::vector<std::string> channels, open, unknown, few;
  std::size_t candidates = 0, unseen = 0;
  for (const DiagnosedBlock& diagnosed : diagnosis.blocks) {
    if (!diagnosed.diagnosis.is_testable) continue;
    for (std::size_t c = 0; c < diagnosed.block.channels.size(); ++c) {
      std::vector<std::string>& among = IsUnconfirmed(diagnosed, c) ? open : channels;
      among.push_back(QuantityOf(diagnosed.block.channels[c].name));
    }
    for (const ResidualVerdict& verdict : diagnosed.diagnosis.residual_verdicts) {
      const std::string quantity = QuantityOf(diagnosed.block.channels[verdict.channel].name);
      if (verdict.kind == ResidualVerdict::Kind::kUnknown) unknown.push_back(quantity);
      if (verdict.kind == ResidualVerdict::Kind::kOfFew) few.push_back(quantity);
    }
    candidates += diagnosed.diagnosis.detectability.size();
    for (const Detectability& one : diagnosed.diagnosis.detectability)
      unseen += one.smallest ? 0 : 1;
  }
  if (channels.empty() && !open.empty()) {
    return fmt::format("Nothing is named: what was chosen for {} is not confirmed.", Listed(open));
  }
  const std::vector<std::string> sensors = ComparedSensors(diagnosis.sensors);
  const std::string together =
      sensors.empty() ? ""
      : sensors.size() == 1
          ? fmt::format("{} measured a motion that the machine can have.", sensors[0])
          : fmt::format("{} agree with each other.", Listed(sensors));
  if (channels.empty() && !together.empty()) return "Nothing found: " + together;
  if (channels.empty()) {
    const bool is_over = std::any_of(
        diagnosis.blocks.begin(), diagnosis.blocks.end(),
        [](const DiagnosedBlock& diagnosed) { return diagnosed.diagnosis.out_of_time; });
    return is_over ? "Nothing judged: the time was over before any channel was."
                   : "Nothing compared: no channel of the recording can be judged.";
  }
  std::string text = fmt::format(
      "Nothing found: {} agree{} with the simulation, but for noise and what nominal "
      "numbers are off by.",
      Listed(channels), channels.size() == 1 ? "s" : "");
  if (!together.empty()) text += " " + Capitalised(together);
  if (!few.empty()) {
    text += fmt::format(" Not so in a few manoeuvres of {}.", Listed(few));
  }
  if (!unknown.empty()) {
    text += fmt::format(
        " What is left of {} may be noise or error: a recording without rest does not tell.",
        Listed(unknown));
  }
  if (unseen > 0) {
    text += fmt::format(" Of {} mechanisms looked for, {} could not have been seen at any size.",
                        candidates, unseen);
  }
  return text;
}

/// The corrections of blocks that are judged: those of others change no answer.
std::vector<DiscrepancyCorrection> CorrectionsOfJudged(const Diagnosis& diagnosis) {
  std::vector<DiscrepancyCorrection> judged;
  for (const DiagnosedBlock& diagnosed : diagnosis.blocks) {
    for (const Channel& channel : diagnosed.block.channels) {
      for (const DiscrepancyCorrection& one : diagnosis.discrepancy_corrections) {
        if (diagnosed.diagnosis.is_testable && one.channel == channel.name) judged.push_back(one);
      }
    }
  }
  return judged;
}

bool NoneIsJudged(const Diagnosis& diagnosis) {
  return std::none_of(
      diagnosis.blocks.begin(), diagnosis.blocks.end(),
      [](const DiagnosedBlock& diagnosed) { return diagnosed.diagnosis.is_testable; });
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

std::vector<std::string> SentencesOf(const Diagnosis& diagnosis) {
  std::vector<std::string> sentences;
  for (const auto& [diagnosed, finding] : RankedFindings(diagnosis)) {
    sentences.push_back(SentenceOf(*diagnosed, *finding));
  }
  for (const auto& [diagnosed, unexplained] : RankedUnexplained(diagnosis)) {
    sentences.push_back(SentenceOf(*diagnosed, *unexplained));
    for (const Proposal& proposal : diagnosed->proposals) {
      if (proposal.channel != unexplained->location.channel) continue;
      sentences.push_back(SentenceOf(diagnosed->block, proposal));
    }
  }
  if (std::string text = SentenceOfSharedDelay(diagnosis); !text.empty()) {
    sentences.push_back(std::move(text));
  }
  for (std::string& text : SensorSentences(diagnosis.sensors)) sentences.push_back(std::move(text));
  const std::vector<std::string> seen = PerceptionSentences(diagnosis.perception);
  const bool is_seen =
      std::any_of(diagnosis.perception.begin(), diagnosis.perception.end(),
                  [](const PerceptionDiagnosis& sensor) { return !sensor.findings.empty(); });
  const bool has_blocks = !diagnosis.blocks.empty() || diagnosis.perception.empty();
  const bool is_nothing = sentences.empty() && has_blocks;
  if (is_seen) sentences.insert(sentences.end(), seen.begin(), seen.end());
  if (is_nothing && !(is_seen && NoneIsJudged(diagnosis))) {
    sentences.push_back(SentenceOfNothing(diagnosis));
  }
  for (const DiagnosedBlock& diagnosed : diagnosis.blocks) {
    for (const Finding& finding : diagnosed.diagnosis.proxies) {
      sentences.push_back(SentenceOfProxy(diagnosed, finding));
    }
    for (const Finding& finding : diagnosed.diagnosis.unconfirmed) {
      sentences.push_back(SentenceOfUnconfirmed(diagnosed, finding));
    }
    for (const Finding& finding : diagnosed.diagnosis.within_tolerance) {
      sentences.push_back(SentenceOfExpected(diagnosed, finding));
    }
    if (!diagnosed.diagnosis.is_testable) sentences.push_back(SentenceOfUntestable(diagnosed));
  }
  for (std::string& text : OtherSensorSentences(diagnosis.sensors)) {
    sentences.push_back(std::move(text));
  }
  for (const std::string& obstacle : diagnosis.not_compared) {
    sentences.push_back(fmt::format("Not compared: {}.", obstacle));
  }
  for (const ExcludedSamples& one : diagnosis.excluded_samples) {
    sentences.push_back(
        fmt::format("Excluded: {:.0f} % of {}, where loose ground may let the machine lag behind "
                    "its tracks.",
                    100 * one.share, QuantityOf(one.channel)));
  }
  if (!is_seen) sentences.insert(sentences.end(), seen.begin(), seen.end());
  for (const HeldOutRecording& further : diagnosis.held_out) {
    sentences.push_back(SentenceOf(further));
  }
  if (std::string text = SentenceOf(CorrectionsOfJudged(diagnosis)); !text.empty()) {
    sentences.push_back(std::move(text));
  }
  if (diagnosis.whole) sentences.push_back(SentenceOf(*diagnosis.whole));
  if (diagnosis.levers_are_the_scenarios) {
    sentences.push_back("The recording has no levers: those that the scenario replays are taken.");
  }
  if (diagnosis.machine != diagnosis.scenario) {
    sentences.push_back(fmt::format("The recording's {} is taken for the scenario's {}.",
                                    diagnosis.machine, diagnosis.scenario));
  }
  if (diagnosis.next) sentences.push_back(SentenceOf(*diagnosis.next));
  if (std::string text = SentenceOfEncoderLead(diagnosis); !text.empty()) {
    sentences.insert(sentences.begin(), std::move(text));
  }
  for (const MissingInput& missing : diagnosis.missing_input) {
    sentences.insert(sentences.begin(), SentenceOf(missing));
  }
  return sentences;
}

}  // namespace tera
