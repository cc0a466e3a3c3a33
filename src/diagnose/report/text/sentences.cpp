#include "diagnose/report/text/sentences.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "diagnose/diagnosis.h"
#include "diagnose/report/text/confirmation_text.h"
#include "diagnose/report/text/sensor_text.h"
#include "diagnose/report/text/sentence.h"
#include "diagnose/report/text/words.h"

namespace tera {
namespace {

/// Two delays agree if they differ by less than kSameShare of the longer one, or by less than
/// kSameDeviations standard deviations. Delays that differ by more than kMostDifference of the
/// longer one never agree.
constexpr double kSameShare = 0.2, kSameDeviations = 3, kMostDifference = 0.5;

std::optional<ParameterEstimate> DelayOf(const DiagnosedBlock& diagnosed) {
  for (const Finding& finding : diagnosed.diagnosis.findings) {
    if (finding.term.candidate->mechanism->id == "command_delay") return finding.parameters.front();
  }
  return std::nullopt;
}

bool AreTheSame(const ParameterEstimate& shortest, const ParameterEstimate& longest) {
  const double sigma = std::hypot(shortest.sigma.value_or(0), longest.sigma.value_or(0));
  const double uncertain = std::min(kSameDeviations * sigma, kMostDifference * longest.value);
  return longest.value - shortest.value <= std::max(kSameShare * longest.value, uncertain);
}

}  // namespace

std::string SentenceOfSharedDelay(const Diagnosis& diagnosis) {
  std::vector<ParameterEstimate> delays;
  for (const DiagnosedBlock& diagnosed : diagnosis.blocks) {
    if (!diagnosed.diagnosis.is_testable || !HasLever(diagnosed.block)) continue;
    const std::optional<ParameterEstimate> delay = DelayOf(diagnosed);
    if (!delay) return "";
    delays.push_back(*delay);
  }
  if (delays.size() < 2) return "";
  const auto [shortest, longest] = std::minmax_element(
      delays.begin(), delays.end(),
      [](const ParameterEstimate& a, const ParameterEstimate& b) { return a.value < b.value; });
  if (!AreTheSame(*shortest, *longest)) return "";
  double mean_s = 0;
  for (const ParameterEstimate& delay : delays) mean_s += delay.value / delays.size();
  return fmt::format(
      "All {} joints and tracks that follow levers ask for a delay of about {} s: the clock of the "
      "encoders, or of the levers, "
      "may be off by it instead, which is not told apart.",
      delays.size(), Significant(mean_s, 2));
}

std::string SentenceOfEncoderLead(const Diagnosis& diagnosis) {
  if (!diagnosis.encoder_lead_s) return "";
  return fmt::format(
      "Encoders run ahead of the levers that move them, by about {} s: their clocks differ. Mend "
      "that first; what is named below may be a proxy for it.",
      Significant(*diagnosis.encoder_lead_s, 2));
}

namespace {

/// Each name once, with its count if repeated: "terrain height in 16 places".
std::vector<std::string> Counted(const std::vector<std::string>& names) {
  std::vector<std::string> counted;
  for (auto name = names.begin(); name != names.end(); ++name) {
    if (std::find(names.begin(), name, *name) != name) continue;
    const auto times = std::count(names.begin(), names.end(), *name);
    counted.push_back(times > 1 ? fmt::format("{} in {} places", *name, times) : *name);
  }
  return counted;
}

std::string FoundText(const Diagnosis& diagnosis) {
  std::vector<std::string> targets;
  std::map<std::string, std::vector<std::string>> names;
  for (const Cause& cause : RankedCauses(diagnosis)) {
    const std::vector<std::string> alike = AlikeTexts(*cause.finding);
    std::string name = NameAndNumbers(*cause.finding);
    if (!alike.empty()) name += fmt::format(" (or {})", fmt::join(alike, " or "));
    if (names[cause.target()].empty()) targets.push_back(cause.target());
    names[cause.target()].push_back(std::move(name));
  }
  std::vector<std::string> parts;
  for (const std::string& target : targets) {
    parts.push_back(fmt::format("{}: {}", Spaced(target), Listed(Counted(names[target]))));
  }
  return parts.empty() ? "" : fmt::format(" {}.", fmt::join(parts, "; "));
}

std::string UnexplainedText(const Diagnosis& diagnosis) {
  std::vector<std::string> quantities;
  for (const auto& [diagnosed, unexplained] : RankedUnexplained(diagnosis)) {
    quantities.push_back(QuantityOf(diagnosed->block.channels[unexplained->location.channel].name));
  }
  for (const ChannelError* left : UnexplainedOfSensors(diagnosis)) {
    quantities.push_back(QuantityOf(left->name));
  }
  return quantities.empty() ? "" : fmt::format(" Unexplained: {}.", Listed(quantities));
}

}  // namespace

std::string SummaryOf(const Diagnosis& diagnosis) {
  const std::string found = FoundText(diagnosis), unexplained = UnexplainedText(diagnosis);
  if (found.empty() && unexplained.empty()) return "";
  return fmt::format("In short:{}{}", found.empty() ? " nothing named." : found, unexplained);
}

namespace {

/// Corrections of judged blocks. Corrections of other blocks do not change the result.
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

}  // namespace

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

std::string SentenceOf(const Cause& cause) {
  if (cause.block != nullptr) return SentenceOf(*cause.block, *cause.finding);
  if (cause.sensor != nullptr) return SentenceOf(*cause.sensor);
  return SentenceOf(*cause.seen_by, *cause.seen);
}

std::vector<std::string> SentencesOf(const Diagnosis& diagnosis) {
  std::vector<std::string> sentences;
  const auto say = [&](std::string text) {
    if (!text.empty()) sentences.push_back(std::move(text));
  };
  const auto say_all = [&](const std::vector<std::string>& texts) {
    sentences.insert(sentences.end(), texts.begin(), texts.end());
  };
  for (const Cause& cause : RankedCauses(diagnosis)) {
    if (cause.block != nullptr) say(SentenceOf(cause));
  }
  for (const auto& [diagnosed, unexplained] : RankedUnexplained(diagnosis)) {
    say(SentenceOf(*diagnosed, *unexplained));
    const Learned* learned = LearnedOf(*diagnosed, unexplained->location.channel);
    if (learned != nullptr) say(SentenceOf(diagnosed->block, *learned));
  }
  say(SentenceOfSharedDelay(diagnosis));
  for (const SensorFound& found : diagnosis.sensors.findings) {
    say(SentenceOf(found));
  }
  say(SentenceOfUnexplained(UnexplainedOfSensors(diagnosis)));
  const std::vector<std::string> seen = PerceptionSentences(diagnosis.perception);
  const bool is_seen =
      std::any_of(diagnosis.perception.begin(), diagnosis.perception.end(),
                  [](const PerceptionDiagnosis& sensor) { return !sensor.findings.empty(); });
  const bool has_blocks = !diagnosis.blocks.empty() || diagnosis.perception.empty();
  const bool is_nothing = sentences.empty() && has_blocks;
  if (is_seen) say_all(seen);
  if (is_nothing && !(is_seen && NoneIsJudged(diagnosis))) {
    say(SentenceOfNothing(diagnosis));
  }
  for (const DiagnosedBlock& diagnosed : diagnosis.blocks) {
    for (const Finding& finding : diagnosed.diagnosis.proxies) {
      say(SentenceOfProxy(diagnosed, finding));
    }
    for (const Finding& finding : diagnosed.diagnosis.unconfirmed) {
      say(SentenceOfUnconfirmed(diagnosed, finding));
    }
    const std::optional<PlainComparison>& plain = diagnosed.diagnosis.plain;
    if (plain && plain->is_better && !diagnosed.diagnosis.unconfirmed.empty()) {
      say(
          fmt::format("{}: a static map of its lever with a dead time of {:.2f} s leaves less than "
                      "what was found does on what was kept back; so none of it is confirmed.",
                      diagnosed.block.name, plain->dead_time_s));
    }
    for (const Finding& finding : diagnosed.diagnosis.within_tolerance) {
      say(SentenceOfExpected(diagnosed, finding));
    }
    if (!diagnosed.diagnosis.is_testable) say(SentenceOfUntestable(diagnosed));
  }
  say_all(OtherSensorSentences(diagnosis.sensors));
  for (const std::string& obstacle : diagnosis.not_compared) {
    say(fmt::format("Not compared: {}.", obstacle));
  }
  for (const ExcludedSamples& one : diagnosis.excluded_samples) {
    say(
        fmt::format("Excluded: {:.0f} % of {}, where loose ground may let the machine lag behind "
                    "its tracks.",
                    100 * one.share, QuantityOf(one.channel)));
  }
  if (!is_seen) say_all(seen);
  for (const HeldOutRecording& further : diagnosis.held_out) {
    say(SentenceOf(further));
  }
  say(SentenceOf(CorrectionsOfJudged(diagnosis)));
  if (diagnosis.whole) say(SentenceOf(*diagnosis.whole));
  if (diagnosis.levers_are_the_scenarios) {
    say("The recording has no levers: those that the scenario replays are taken.");
  }
  if (diagnosis.machine != diagnosis.scenario) {
    say(fmt::format("The recording's {} is taken for the scenario's {}.", diagnosis.machine,
                    diagnosis.scenario));
  }
  if (diagnosis.next) say(SentenceOf(*diagnosis.next));
  if (std::string text = SentenceOfEncoderLead(diagnosis); !text.empty()) {
    sentences.insert(sentences.begin(), std::move(text));
  }
  for (const MissingInput& missing : diagnosis.missing_input) {
    sentences.insert(sentences.begin(), SentenceOf(missing));
  }
  return sentences;
}

}  // namespace tera
