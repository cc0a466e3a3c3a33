#include "dataset/import/suggest/command_guess.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>

namespace tera {
namespace {

template <std::size_t n>
bool IsOneOf(const std::string& word, const std::array<std::string_view, n>& words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

constexpr std::array<std::string_view, 9> kLeverWords = {
    "lever", "joystick", "joy", "pedal", "handle", "spool", "pwm", "hebel", "manette"};
constexpr std::array<std::string_view, 18> kCommandWords = {
    "cmd",       "command", "commanded", "ref",      "reference", "setpoint",
    "setpoints", "sp",      "target",    "desired",  "des",       "demand",
    "goal",      "request", "soll",      "sollwert", "consigne",  "vorgabe"};
/// Words for quantities that have a unit and thus are not levers.
constexpr std::array<std::string_view, 22> kQuantityWords = {
    "speed", "vel", "velocity",        "rate",   "angle", "pos",   "position", "pressure",
    "flow",  "rpm", "force",           "torque", "omega", "yaw",   "heading",  "deg",
    "rad",   "mps", "geschwindigkeit", "winkel", "druck", "stroke"};

struct Direction {
  std::string_view plus, minus;
};
constexpr Direction kDirections[] = {
    {"up", "down"},    {"raise", "lower"},      {"out", "in"},          {"extend", "retract"},
    {"open", "close"}, {"forward", "backward"}, {"forward", "reverse"}, {"left", "right"},
    {"pos", "neg"},    {"plus", "minus"},       {"dump", "curl"}};

bool IsCommandWord(const std::string& word) {
  return IsOneOf(word, kCommandWords) || word.starts_with("soll");
}

struct Named {
  const NumbersOfColumn* column = nullptr;
  std::vector<std::string> rest;  ///< words that identify the lever
  bool is_lever = false, is_command = false, has_quantity = false;
};

Named NamedBy(const NumbersOfColumn& column) {
  Named named{.column = &column};
  for (const std::string& word : WordsOfName(column.name)) {
    const bool is_lever = IsOneOf(word, kLeverWords), is_command = IsCommandWord(word);
    named.is_lever = named.is_lever || is_lever;
    named.is_command = named.is_command || is_command;
    named.has_quantity = named.has_quantity || IsOneOf(word, kQuantityWords);
    if (!is_lever && !is_command) named.rest.push_back(word);
  }
  return named;
}

bool IsSlew(const std::string& word) {
  const std::string joint = JointOfWord(word);
  return joint == "slew" || joint == "swing";
}

/// Name made of the words, such as "left_track"; the joint's name if the only word denotes a joint.
std::string NameOfWords(const std::vector<std::string>& words) {
  const std::string joint = words.size() == 1 ? JointOfWord(words.front()) : "";
  return joint.empty() ? PlainNameOf(fmt::format("{}", fmt::join(words, "_"))) : joint;
}

bool IsJoint(const std::vector<std::string>& words) {
  const std::string joined = fmt::format("{}", fmt::join(words, "_"));
  return joined == "left_track" || joined == "right_track" || joined == "blade" ||
         (words.size() == 1 && !JointOfWord(words.front()).empty());
}

/// The name without its direction, and the direction. Two levers for opposite directions belong to
/// one joint.
std::optional<std::pair<std::vector<std::string>, bool>> WithoutDirection(const Named& named) {
  for (const Direction& direction : kDirections) {
    for (const bool is_plus : {true, false}) {
      std::vector<std::string> words = named.rest;
      const auto at =
          std::find(words.begin(), words.end(), is_plus ? direction.plus : direction.minus);
      if (at == words.end()) continue;
      words.erase(at);
      const bool by_sides = direction.plus == "left";
      if (by_sides && !(words.size() == 1 && IsSlew(words.front()))) continue;
      if (!words.empty()) return std::pair(words, is_plus);
    }
  }
  return std::nullopt;
}

bool IsLever(const Named& named) {
  if (named.rest.empty()) return false;
  // A fraction has no unit or per cent; a pulse has a unit of time or none.
  const UnitGuess unit = GuessAnyUnit(*named.column);
  if (unit.unit != "1" && unit.unit != "%" && unit.unit != "us") return false;
  if (named.is_lever) return true;
  if (!named.is_command || named.has_quantity) return false;
  const auto one_way = WithoutDirection(named);
  return IsJoint(named.rest) || (one_way && IsJoint(one_way->first));
}

/// Encoding of the values of a lever.
struct LeverCoding {
  std::string keys;    ///< keys that follow the column
  std::string remark;  ///< empty for the usual encoding
};

LeverCoding CodingOf(const std::vector<Named>& levers) {
  double most = 0, least = 0;
  for (std::size_t k = 0; k < levers.size(); ++k) {
    const auto& values = levers[k].column->values;
    if (values.empty()) continue;
    most = std::max(most, levers[k].column->LargestSize());
    least = k == 0 ? levers[k].column->Least() : std::min(least, levers[k].column->Least());
  }
  // Limits allow an overshoot of some per cent.
  constexpr double kMostShare = 1.5, kMostPerCent = 110, kMostThousandths = 1100;
  constexpr double kLeastPulse = 800, kMostPulse = 2200, kMostByte = 255;
  if (most <= kMostShare) return {"unit: '1'", ""};
  if (most <= kMostPerCent) return {"unit: '%'", ""};
  if (least >= kLeastPulse && most <= kMostPulse) {
    return {"unit: '1', scale: 0.002, offset: -3", "pulses of 1000 to 2000 us, at rest 1500"};
  }
  if (least >= 0 && most <= kMostByte) {
    return {"unit: '1', scale: 0.0078431, offset: -1", "bytes of 0 to 255, at rest 127.5"};
  }
  if (least < 0 && most <= kMostThousandths && most > kMostByte) {
    return {"unit: '1', scale: 0.001", "thousandths"};
  }
  return {"unit: '1'", "no share of full: give scale and offset"};
}

/// Per cent if the column is in per cent, or else the encoding common to all levers.
LeverCoding CodingOf(const Named& lever, const LeverCoding& of_all) {
  return GuessAnyUnit(*lever.column).unit == "%" ? LeverCoding{"unit: '%'", ""} : of_all;
}

CommandLine LineOf(const Named& lever, const LeverCoding& of_all) {
  const LeverCoding coding = CodingOf(lever, of_all);
  const std::string size = fmt::format("up to {:.4g}", lever.column->LargestSize());
  return {NameOfWords(lever.rest),
          fmt::format("{{column: {}, {}}}", YamlWord(lever.column->name), coding.keys),
          coding.remark.empty() ? size : coding.remark + ", " + size,
          {lever.column}};
}

/// A lever from two columns with opposite directions, as the difference `plus` - `minus`.
CommandLine DifferenceOf(const Named& plus, const Named& minus, const LeverCoding& coding,
                         const std::vector<std::string>& words) {
  const auto term = [&](const Named& named, const char* scale) {
    return fmt::format("{{column: {}, {}{}}}", YamlWord(named.column->name), coding.keys, scale);
  };
  return {NameOfWords(words),
          fmt::format("{{sum: [{}, {}]}}", term(plus, ""), term(minus, ", scale: -1")),
          "which of the two is positive",
          {plus.column, minus.column}};
}

}  // namespace

std::vector<CommandLine> GuessLevers(const std::vector<const NumbersOfColumn*>& columns) {
  std::vector<Named> levers;
  for (const NumbersOfColumn* column : columns) {
    if (const Named named = NamedBy(*column); IsLever(named)) levers.push_back(named);
  }
  const LeverCoding coding = CodingOf(levers);
  std::vector<CommandLine> lines;
  std::set<const NumbersOfColumn*> taken;
  for (const Named& lever : levers) {
    if (taken.contains(lever.column)) continue;
    const auto way = WithoutDirection(lever);
    const auto other = std::find_if(levers.begin(), levers.end(), [&](const Named& candidate) {
      const auto its = WithoutDirection(candidate);
      return way && its && its->first == way->first && its->second != way->second;
    });
    const bool are_one_sided = way && other != levers.end() && lever.column->Least() >= 0 &&
                               other->column->Least() >= 0 &&
                               coding.keys.find("scale") == std::string::npos;
    if (are_one_sided) {
      lines.push_back(way->second ? DifferenceOf(lever, *other, coding, way->first)
                                  : DifferenceOf(*other, lever, coding, way->first));
      taken.insert(other->column);
    } else {
      lines.push_back(LineOf(lever, coding));
    }
  }
  return lines;
}

std::vector<CommandLine> GuessSetpoints(const std::vector<const NumbersOfColumn*>& columns) {
  std::vector<CommandLine> lines;
  for (const NumbersOfColumn* column : columns) {
    const Named named = NamedBy(*column);
    if (!named.is_command || named.rest.empty() || IsLever(named)) continue;
    const UnitGuess unit = GuessAnyUnit(*column);
    lines.push_back(
        {PlainNameOf(column->name), ColumnYaml(column->name, unit), unit.doubt, {column}});
  }
  return lines;
}

}  // namespace tera
