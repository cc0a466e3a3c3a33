#include "diagnose/report/text/sentences.h"

#include <fmt/format.h>

#include <algorithm>

#include "diagnose/report/text/clock_text.h"
#include "diagnose/report/text/confirmation_text.h"
#include "diagnose/report/text/finding_text.h"
#include "diagnose/report/text/next_manoeuvre_text.h"
#include "diagnose/report/text/perception_text.h"
#include "diagnose/report/text/proposal_text.h"
#include "diagnose/report/text/ranking.h"
#include "diagnose/report/text/sensor_text.h"
#include "diagnose/report/text/sentence.h"
#include "diagnose/report/text/wording.h"

namespace tera {
namespace {

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
    const std::optional<PlainComparison>& plain = diagnosed.diagnosis.plain;
    if (plain && plain->is_better && !diagnosed.diagnosis.unconfirmed.empty()) {
      sentences.push_back(
          fmt::format("{}: a static map of its lever with a dead time of {:.2f} s leaves less than "
                      "what was found does on what was kept back; so none of it is confirmed.",
                      diagnosed.block.name, plain->dead_time_s));
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
