#include "diagnose/report/page/chain_figure.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/html.h"
#include "diagnose/diagnosis.h"
#include "diagnose/report/text/cause_text.h"
#include "diagnose/report/text/sensor_text.h"
#include "diagnose/report/text/words.h"

namespace tera {
namespace {

using Chain = std::array<ChainStage, 6>;

enum Stage : std::size_t { kLever, kValve, kPump, kJoint, kGround, kSensor };

Stage StageOf(Slot slot) {
  switch (slot) {
    case Slot::kCommandTiming:
      return kLever;
    case Slot::kLeverMap:
      return kValve;
    case Slot::kFlow:
      return kPump;
    case Slot::kActuator:
    case Slot::kKinematicGain:
    case Slot::kLoadFriction:
      return kJoint;
    case Slot::kGround:
    case Slot::kScene:
      return kGround;
    case Slot::kSensorGeometry:
    case Slot::kSensorStatic:
    case Slot::kSensorTiming:
      break;
  }
  return kSensor;
}

/// Stage at which the error of a block was measured.
Stage StageOf(const ReplayBlock& block) {
  const auto has = [&](Stage stage) {
    return std::any_of(block.candidates.begin(), block.candidates.end(),
                       [&](const Candidate& one) { return StageOf(one.mechanism->slot) == stage; });
  };
  if (HasLever(block)) return kJoint;
  return has(kGround) ? kGround : has(kSensor) ? kSensor : kJoint;
}

template <typename Item>
void AddOnce(Item item, std::vector<Item>* items) {
  if (std::find(items->begin(), items->end(), item) == items->end()) {
    items->push_back(std::move(item));
  }
}

/// Sensor name of a channel: "imu" of "excavator1/imu/wx_radps".
std::string SensorOfChannel(const std::string& channel) {
  const auto first = channel.find('/'), last = channel.rfind('/');
  return Spaced(last > first ? channel.substr(first + 1, last - first - 1) : channel);
}

void AddCompared(const Diagnosis& diagnosis, Chain* chain) {
  for (const DiagnosedBlock& diagnosed : diagnosis.blocks) {
    if (!diagnosed.diagnosis.is_testable) continue;
    for (const Candidate& candidate : diagnosed.block.candidates) {
      const Stage stage = StageOf(candidate.mechanism->slot);
      const bool is_shared = stage == kPump || stage == kSensor;
      AddOnce(Spaced(is_shared ? candidate.target : diagnosed.block.name),
              &(*chain)[stage].compared);
    }
  }
  for (std::string& name : ComparedSensors(diagnosis.sensors)) {
    AddOnce(std::move(name), &(*chain)[kSensor].compared);
  }
  for (const PerceptionDiagnosis& sensor : diagnosis.perception) {
    if (!sensor.is_judged()) continue;
    AddOnce(Spaced(sensor.target), &(*chain)[kSensor].compared);
    if (!sensor.ground.cells.empty())
      AddOnce<std::string>("ground and site", &(*chain)[kGround].compared);
  }
}

void AddEntry(Stage stage, bool is_cause, std::string text, Chain* chain) {
  AddOnce({is_cause, std::move(text)}, &(*chain)[stage].entries);
}

std::string TextOf(const Candidate& candidate) {
  return fmt::format("{}: {}", Spaced(candidate.target),
                     WordsOf(candidate.mechanism->id, candidate.target)->label);
}

/// Adds a cause, and its rivals as possible causes in other stages.
void AddCause(const Cause& cause, Chain* chain) {
  const Stage stage = StageOf(cause.mechanism().slot);
  std::string text = TextOf(*cause.finding->term.candidate);
  std::size_t beside = 0;
  for (const Candidate* rival : RivalsOf(*cause.finding)) {
    const Stage of_rival = StageOf(rival->mechanism->slot);
    if (of_rival == stage) ++beside;
    if (of_rival != stage) AddEntry(of_rival, false, TextOf(*rival), chain);
  }
  if (beside > 0) text += fmt::format(" or {} other{}", beside, beside == 1 ? "" : "s");
  AddEntry(stage, true, std::move(text), chain);
}

void AddEntries(const Diagnosis& diagnosis, Chain* chain) {
  for (const MissingInput& missing : diagnosis.missing_input) {
    AddEntry(kLever, false, Spaced(missing.axis) + ": input missing", chain);
  }
  if (diagnosis.encoder_lead_s) {
    AddEntry(kSensor, true,
             fmt::format("encoders: clock {} s ahead", Significant(*diagnosis.encoder_lead_s, 2)),
             chain);
  }
  for (const Cause& cause : CausesOf(diagnosis)) AddCause(cause, chain);
  for (const auto& [diagnosed, left] : RankedUnexplained(diagnosis)) {
    AddEntry(StageOf(diagnosed->block), false,
             QuantityOf(diagnosed->block.channels[left->location.channel].name) + ": unexplained",
             chain);
  }
  for (const ChannelError* channel : UnexplainedOfSensors(diagnosis)) {
    AddEntry(kSensor, false, SensorOfChannel(channel->name) + ": unexplained", chain);
  }
}

constexpr std::size_t kMostEntries = 4;  ///< maximum per box

/// A sign with the same meaning as a box's frame, readable without colour.
std::string Sign(std::string_view css_class, std::string_view sign) {
  return fmt::format("<b class='sign {}'>{}</b>", css_class, sign);
}

std::string Box(const ChainStage& stage) {
  const bool is_wrong = std::any_of(stage.entries.begin(), stage.entries.end(),
                                    [](const ChainStage::Entry& one) { return one.is_cause; });
  const bool was_compared = !stage.compared.empty();
  const char* const css_class = is_wrong                 ? "wrong"
                                : !stage.entries.empty() ? "open"
                                : was_compared           ? "fine"
                                                         : "idle";
  std::string html = fmt::format("<li class='{}'><b>{}</b>", css_class, stage.title);
  for (std::size_t e = 0; e < std::min(stage.entries.size(), kMostEntries); ++e) {
    const ChainStage::Entry& entry = stage.entries[e];
    html += fmt::format("<p>{} {}</p>", entry.is_cause ? Sign("wrong", "!") : Sign("open", "?"),
                        Escaped(entry.text));
  }
  if (stage.entries.size() > kMostEntries) {
    html += fmt::format("<p>and {} more</p>", stage.entries.size() - kMostEntries);
  }
  if (stage.entries.empty()) {
    html += fmt::format("<p class='soft'>{} {}</p>",
                        was_compared ? Sign("fine", "&#10003;") : Sign("idle", "&#8211;"),
                        was_compared ? Escaped(Listed(stage.compared)) : "not compared");
  }
  return html + "</li>\n";
}

constexpr std::string_view kKey =
    "<p class='chainkey'><span><b class='sign wrong'>!</b> a cause is named</span> <span><b "
    "class='sign open'>?</b> a possible cause, unexplained error or missing input</span> <span><b "
    "class='sign fine'>&#10003;</b> compared, nothing found</span> <span><b class='sign "
    "idle'>&#8211;</b> not compared</span></p>\n";

}  // namespace

std::array<ChainStage, 6> ChainOf(const Diagnosis& diagnosis) {
  Chain chain = {{{"Lever", {}, {}},
                  {"Valve", {}, {}},
                  {"Pump", {}, {}},
                  {"Drive, joint", {}, {}},
                  {"Ground", {}, {}},
                  {"Sensor", {}, {}}}};
  AddCompared(diagnosis, &chain);
  AddEntries(diagnosis, &chain);
  return chain;
}

std::string ChainFigure(const Diagnosis& diagnosis) {
  std::string boxes;
  for (const ChainStage& stage : ChainOf(diagnosis)) boxes += Box(stage);
  return fmt::format("<ol class='chain'>\n{}</ol>\n{}", boxes, kKey);
}

}  // namespace tera
