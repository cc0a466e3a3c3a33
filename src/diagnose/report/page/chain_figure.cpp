#include "diagnose/report/page/chain_figure.h"

#include <fmt/format.h>

#include <algorithm>

#include "diagnose/report/page/svg_plot.h"
#include "diagnose/report/text/cause.h"
#include "diagnose/report/text/mechanism_words.h"
#include "diagnose/report/text/plain_sentence.h"
#include "diagnose/report/text/ranking.h"
#include "diagnose/report/text/sensor_text.h"
#include "diagnose/report/text/wording.h"

namespace tera {
namespace {

using Chain = std::array<ChainStage, 6>;
using Mark = ChainStage::Mark;

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

/// Where the error of a block was measured.
Stage StageOf(const ReplayBlock& block) {
  const auto has = [&](Stage stage) {
    return std::any_of(block.candidates.begin(), block.candidates.end(),
                       [&](const Candidate& one) { return StageOf(one.mechanism->slot) == stage; });
  };
  if (HasLever(block)) return kJoint;
  return has(kGround) ? kGround : has(kSensor) ? kSensor : kJoint;
}

void AddOnce(std::string name, std::vector<std::string>* names) {
  if (std::find(names->begin(), names->end(), name) == names->end()) {
    names->push_back(std::move(name));
  }
}

/// "imu" of "excavator1/imu/wx_radps".
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
    if (!sensor.ground.cells.empty()) AddOnce("ground and site", &(*chain)[kGround].compared);
  }
}

void AddEntry(Stage stage, Mark mark, std::string text, Chain* chain) {
  const ChainStage::Entry entry{mark, std::move(text)};
  auto& entries = (*chain)[stage].entries;
  if (std::find(entries.begin(), entries.end(), entry) == entries.end()) entries.push_back(entry);
}

std::string TextOf(const Candidate& candidate) {
  return fmt::format("{}: {}", Spaced(candidate.target),
                     WordsOf(candidate.mechanism->id, candidate.target)->label);
}

/// A cause, and in other stages what is not told apart from it.
void AddCause(const Cause& cause, Chain* chain) {
  const Stage stage = StageOf(cause.mechanism().slot);
  std::string text = TextOf(*cause.finding->term.candidate);
  std::size_t beside = 0;
  for (const Candidate* rival : RivalsOf(*cause.finding)) {
    const Stage of_rival = StageOf(rival->mechanism->slot);
    if (of_rival == stage) ++beside;
    if (of_rival != stage) AddEntry(of_rival, Mark::kPossibleCause, TextOf(*rival), chain);
  }
  if (beside > 0) text += fmt::format(" or {} other{}", beside, beside == 1 ? "" : "s");
  AddEntry(stage, Mark::kCause, std::move(text), chain);
}

void AddEntries(const Diagnosis& diagnosis, Chain* chain) {
  for (const MissingInput& missing : diagnosis.missing_input) {
    AddEntry(kLever, Mark::kMissingInput, Spaced(missing.axis) + ": input missing", chain);
  }
  if (diagnosis.encoder_lead_s) {
    AddEntry(kSensor, Mark::kCause,
             fmt::format("encoders: clock {} s ahead", Significant(*diagnosis.encoder_lead_s, 2)),
             chain);
  }
  for (const Cause& cause : CausesOf(diagnosis)) AddCause(cause, chain);
  for (const auto& [diagnosed, left] : RankedUnexplained(diagnosis)) {
    AddEntry(StageOf(diagnosed->block), Mark::kUnexplained,
             QuantityOf(diagnosed->block.channels[left->location.channel].name) + ": unexplained",
             chain);
  }
  for (const ChannelError* channel : UnexplainedOfSensors(diagnosis)) {
    AddEntry(kSensor, Mark::kUnexplained, SensorOfChannel(channel->name) + ": unexplained", chain);
  }
}

// Lengths in the figure, which is never scaled. In two rows or three, which the style sheet makes
// of it, boxes stand closer, so that two fit beside each other at 360 px.
constexpr int kWidth = 144, kPitch = 166, kTitle = 40, kLine = 17, kRowGap = 14;
constexpr std::size_t kLetters = 16;  ///< of a line of text beside its mark
constexpr std::size_t kMostLines = 7;

/// A text in lines of at most kLetters letters, where its words allow it.
std::vector<std::string> Wrapped(const std::string& text) {
  std::vector<std::string> lines = {""};
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    const std::string word = text.substr(begin, end - begin);
    std::string& line = lines.back();
    if (line.empty()) {
      line = word;
    } else if (line.size() + 1 + word.size() <= kLetters) {
      line += " " + word;
    } else {
      lines.push_back(word);
    }
    begin = end + 1;
  }
  return lines;
}

/// A line of a box and the mark before it.
struct BoxLine {
  std::string mark, text;
};

const char* SignOf(Mark mark) { return mark == Mark::kCause ? "!" : "?"; }

std::vector<BoxLine> LinesOf(const ChainStage& stage) {
  std::vector<BoxLine> lines;
  for (std::size_t e = 0; e < stage.entries.size(); ++e) {
    const std::vector<std::string> wrapped = Wrapped(stage.entries[e].text);
    if (lines.size() + wrapped.size() > kMostLines) {
      lines.push_back({"", fmt::format("and {} more", stage.entries.size() - e)});
      break;
    }
    for (std::size_t w = 0; w < wrapped.size(); ++w) {
      lines.push_back({w == 0 ? SignOf(stage.entries[e].mark) : "", wrapped[w]});
    }
  }
  if (!lines.empty()) return lines;
  std::vector<std::string> wrapped =
      Wrapped(stage.compared.empty() ? "not compared" : Listed(stage.compared));
  if (wrapped.size() > kMostLines) {
    wrapped.resize(kMostLines - 1);
    wrapped.emplace_back("and more");
  }
  for (std::string& text : wrapped) lines.push_back({"", std::move(text)});
  return lines;
}

std::string_view ClassOf(const ChainStage& stage) {
  const bool is_open = stage.Has(Mark::kUnexplained) || stage.Has(Mark::kMissingInput) ||
                       stage.Has(Mark::kPossibleCause);
  if (stage.Has(Mark::kCause)) return is_open ? "box wrong open" : "box wrong";
  if (is_open) return "box open";
  return stage.compared.empty() ? "box idle" : "box fine";
}

/// The sign in the corner of a box, which says without colour what the box's frame says.
std::string Badge(const ChainStage& stage) {
  constexpr int kX = kWidth - 17, kY = 19;
  if (!stage.entries.empty()) {
    const bool is_wrong = stage.Has(Mark::kCause);
    return fmt::format(
        "<circle class='{0}' cx='{1}' cy='{2}' r='10'/><text class='sign {0}' x='{1}' y='{3}' "
        "text-anchor='middle'>{4}</text>",
        is_wrong ? "wrong" : "open", kX, kY, kY + 5, is_wrong ? "!" : "?");
  }
  const char* const path = stage.compared.empty() ? "h10" : "l4 5 l8 -10";
  return fmt::format("<path class='{}' d='M{} {}{}'/>", stage.compared.empty() ? "idle" : "fine",
                     kX - 6, kY, path);
}

std::string Box(const ChainStage& stage, std::size_t place, int height) {
  std::string svg = fmt::format(
      "<g class='s{0}' transform='translate({1} 0)'><rect class='{2}' x='1' y='1' width='{3}' "
      "height='{4}' rx='8'/><text class='title' x='12' y='24'>{5}</text>",
      place, kPitch * static_cast<int>(place), ClassOf(stage), kWidth - 2, height - 2, stage.title);
  svg += Badge(stage);
  if (place > 0) {
    svg += fmt::format("<path class='arrow' d='M-12 {}h9l-4 -4m4 4l-4 4'/>", height / 2);
  }
  int y = kTitle + kLine - 4;
  const char* const css_class = stage.entries.empty() ? "soft" : "axis";
  for (const BoxLine& line : LinesOf(stage)) {
    const int x = stage.entries.empty() ? 12 : 22;
    if (!line.mark.empty()) {
      svg += fmt::format("<text class='mark' x='11' y='{}'>{}</text>", y, line.mark);
    }
    svg += fmt::format("<text class='{}' x='{}' y='{}'>{}</text>", css_class, x, y,
                       Escaped(line.text));
    y += kLine;
  }
  return svg + "</g>";
}

/// The figure in words, for those who do not see it.
std::string Description(const Chain& chain) {
  std::string text;
  for (const ChainStage& stage : chain) {
    std::vector<std::string> parts;
    for (const ChainStage::Entry& entry : stage.entries) {
      const bool is_possible = entry.mark == Mark::kPossibleCause;
      parts.push_back((is_possible ? "perhaps " : "") + entry.text);
    }
    if (parts.empty()) {
      parts.push_back(stage.compared.empty() ? "not compared"
                                             : "nothing found in " + Listed(stage.compared));
    }
    text += fmt::format("{}{}: {}.", text.empty() ? "" : " ", stage.title, Listed(parts));
  }
  return text;
}

constexpr std::string_view kKey =
    "<p class='chainkey'><span><b class='sign wrong'>!</b> a cause is named</span> <span><b "
    "class='sign open'>?</b> a possible cause, unexplained error or missing input</span> <span><b "
    "class='sign fine'>&#10003;</b> compared, nothing found</span> <span><b class='sign "
    "idle'>&#8211;</b> not compared</span></p>\n";

}  // namespace

bool ChainStage::Has(Mark mark) const {
  return std::any_of(entries.begin(), entries.end(),
                     [&](const Entry& entry) { return entry.mark == mark; });
}

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
  const Chain chain = ChainOf(diagnosis);
  std::size_t most = 1;
  for (const ChainStage& stage : chain) most = std::max(most, LinesOf(stage).size());
  const int height = kTitle + kLine * static_cast<int>(most) + 8, row = height + kRowGap;
  std::string svg = fmt::format(
      "<svg class='chain' role='img' aria-labelledby='chain-title chain-words' "
      "style='--h1:{0}px;--h2:{1}px;--h3:{2}px;--row:{3}px;--row2:{4}px'><title "
      "id='chain-title'>The chain from lever to sensor, and what is wrong in it</title><desc "
      "id='chain-words'>{5}</desc>",
      height, row + height, 2 * row + height, row, 2 * row, Escaped(Description(chain)));
  for (std::size_t place = 0; place < chain.size(); ++place) {
    svg += Box(chain[place], place, height);
  }
  return fmt::format("<figure class='chainbox'>{}</svg>\n{}</figure>\n", svg, kKey);
}

}  // namespace tera
