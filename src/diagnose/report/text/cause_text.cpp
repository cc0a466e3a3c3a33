#include "diagnose/report/text/cause_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <vector>

#include "core/check.h"
#include "diagnose/diagnosis.h"
#include "diagnose/report/text/confirmation_text.h"
#include "diagnose/report/text/sensor_text.h"
#include "diagnose/report/text/sentence.h"
#include "diagnose/report/text/words.h"

namespace tera {
namespace {

constexpr int kDigits = 2;  ///< significant digits in a plain sentence
/// One of several parameters is stated if it differs from no effect by this number of standard
/// deviations.
constexpr double kToldDeviations = 3;
constexpr double kSetAxis = 0.5;  ///< an axis of `axis_flip` is reversed from this value on

std::string Number(const ParameterEstimate& estimate) {
  return Readable(estimate.value, ReadableUnitOf(estimate));
}

std::string Percents(double share) { return Significant(100 * std::abs(share), kDigits) + " %"; }

/// A placeholder of MechanismWords::meaning, such as "offset_s:ahead:behind", split into its parts.
struct Place {
  std::string_view name, above, below;
  char kind = ' ';        ///< sign that separates the words, or # or ^
  bool percents = false;  ///< true: "%" follows the name
};

Place PlaceOf(std::string_view text) {
  Place place;
  const auto end = text.find_first_of("%~?:#^");
  place.name = text.substr(0, end);
  if (end == text.npos) return place;
  place.percents = text[end] == '%';
  text.remove_prefix(end + (place.percents ? 1 : 0));
  if (text.empty()) return place;
  place.kind = text[0];
  const auto second = text.find(place.kind, 1);
  if (second == text.npos) return place;
  place.above = text.substr(1, second - 1);
  place.below = text.substr(second + 1);
  return place;
}

std::string NumberAt(const Place& place, const ParameterEstimate& estimate) {
  const double value = estimate.value;
  const auto word = [&](double from) {
    return std::string(value >= from ? place.above : place.below);
  };
  const std::string size = place.percents ? Percents(value) : Number(estimate);
  switch (place.kind) {
    case '~':
      return Percents(value - 1) + " " + word(1);
    case '?':
      return word(1);
    case ':': {
      const std::string magnitude = value < 0 && !place.percents ? size.substr(1) : size;
      return magnitude + " " + word(0);
    }
    case '#':
      return Readable(value / (2 * std::numbers::pi), ReadableUnit{1, "Hz"});
    case '^':
      return Readable(1 / value, ReadableUnit{1, "s"});
    default:
      return size;
  }
}

/// True if a parameter differs clearly from its value without the finding.
bool IsClear(const Finding& finding, const FreeParameter& free) {
  const ParameterEstimate& estimate = finding.parameters[free.index];
  const Candidate& candidate = *finding.term.candidate;
  if (free.expected &&
      std::abs(estimate.value - free.expected->value) <= free.expected->half_width) {
    return false;
  }
  const double without = candidate.present.empty()
                             ? candidate.mechanism->parameters[free.index].otherwise.value_or(0)
                             : candidate.present[free.index];
  return std::abs(estimate.value - without) > kToldDeviations * estimate.sigma.value_or(0);
}

/// Fitted parameters of a finding with their names, without those in `told`. Only clear ones
/// appear. If none is clear and `told` is empty, all appear.
std::string NamedNumbers(const Finding& finding, const std::set<std::string_view>& told) {
  std::vector<std::string> all, clear;
  for (const FreeParameter& free : finding.term.candidate->free) {
    const ParameterEstimate& estimate = finding.parameters[free.index];
    if (finding.term.IsHeld(free.index) || told.contains(estimate.name)) continue;
    all.push_back(WithoutUnit(estimate.name) + " " + Number(estimate));
    if (IsClear(finding, free)) clear.push_back(all.back());
  }
  return Listed(clear.empty() && told.empty() ? all : clear);
}

std::string AxesText(const Finding& finding) {
  std::vector<std::string> axes;
  for (const ParameterEstimate& estimate : finding.parameters) {
    if (estimate.value > kSetAxis) axes.push_back(estimate.name);
  }
  return axes.empty() ? "" : " along " + Listed(axes);
}

const ParameterEstimate& EstimateAt(std::string_view name, const Finding& finding) {
  if (name == "0") return finding.parameters.front();
  const auto found = std::find_if(finding.parameters.begin(), finding.parameters.end(),
                                  [&](const ParameterEstimate& one) { return one.name == name; });
  TERA_CHECK(found != finding.parameters.end(), name);
  return *found;
}

/// The mechanism's values in the scenario, as a sentence.
std::string PresentText(const Finding& finding) {
  const Candidate& candidate = *finding.term.candidate;
  std::vector<std::string> numbers;
  for (const FreeParameter& free : candidate.free) {
    if (candidate.present.empty() || finding.term.IsHeld(free.index)) continue;
    const ParameterEstimate& estimate = finding.parameters[free.index];
    numbers.push_back(WithoutUnit(estimate.name) + " " +
                      Readable(candidate.present[free.index], ReadableUnitOf(estimate)));
  }
  return numbers.empty() ? "" : fmt::format(" The scenario has {} here.", Listed(numbers));
}

/// "valve curve". On another target than the finding: "delay of the stamps of the sensor imu".
std::string LabelOf(const Candidate& candidate, const Candidate& found) {
  const std::string label(WordsOf(candidate.mechanism->id, candidate.target)->label);
  return candidate.target == found.target ? label : label + " of " + TargetText(candidate);
}

/// Kind of a sensor, to precede its name; "sensor" if the mechanism does not imply a kind.
std::string SensorKindOf(const Mechanism& mechanism) {
  if (mechanism.targets == std::vector{EffectTarget::kImu}) return "inertial unit";
  if (mechanism.targets == std::vector{EffectTarget::kGnss}) return "receiver";
  return "sensor";
}

}  // namespace

std::string TargetText(const Candidate& candidate) {
  const std::string& target = candidate.target;
  const Slot slot = candidate.mechanism->slot;
  if (target == "base") return "the machine";
  if (target == "poses") return "the recorded poses";
  if (target == "encoders") return "the set of encoders";
  if (const auto slash = target.rfind('/'); slash != target.npos) {
    return "the encoder of the " + Spaced(target.substr(slash + 1));
  }
  if (slot == Slot::kFlow) return "the pump " + Spaced(target);
  const bool is_sensor =
      slot == Slot::kSensorGeometry || slot == Slot::kSensorStatic || slot == Slot::kSensorTiming;
  if (is_sensor)
    return fmt::format("the {} {}", SensorKindOf(*candidate.mechanism), Spaced(target));
  return "the " + Spaced(target);
}

std::string FilledIn(std::string_view meaning, const Finding& finding) {
  const std::string target = TargetText(*finding.term.candidate);
  std::set<std::string_view> told;
  std::string text;
  while (!meaning.empty()) {
    const auto open = meaning.find('{');
    text += meaning.substr(0, open);
    if (open == meaning.npos) break;
    const auto close = meaning.find('}', open);
    const Place place = PlaceOf(meaning.substr(open + 1, close - open - 1));
    meaning.remove_prefix(close + 1);
    if (place.name == "The" || place.name == "the") {
      text += place.name == "The" ? Capitalised(target) : target;
    } else if (place.name == "numbers" || place.name == "axes") {
      text += place.name == "axes" ? AxesText(finding) : NamedNumbers(finding, told);
      for (const ParameterEstimate& estimate : finding.parameters) told.insert(estimate.name);
    } else {
      const ParameterEstimate& estimate = EstimateAt(place.name, finding);
      told.insert(estimate.name);
      text += NumberAt(place, estimate);
    }
  }
  const std::string others = NamedNumbers(finding, told);
  if (!others.empty()) text += fmt::format(" Besides: {}.", others);
  return text + PresentText(finding);
}

std::string MeaningText(const Cause& cause) {
  if (cause.seen != nullptr && cause.seen->place) return "";
  const MechanismWords* words = WordsOf(cause.mechanism().id, cause.target());
  TERA_CHECK(words != nullptr, cause.mechanism().id);
  return FilledIn(words->meaning, *cause.finding);
}

std::string HeadingOf(const Candidate& found, const std::vector<const Candidate*>& alike) {
  std::vector<std::string> labels = {LabelOf(found, found)};
  for (const Candidate* one : alike) {
    if (one != &found) labels.push_back(LabelOf(*one, found));
  }
  return fmt::format("{}: {}",
                     Capitalised(TargetText(found).substr(std::string_view("the ").size())),
                     fmt::join(labels, " or "));
}

namespace {

/// p-values of selection and confirmation up to which a cause is called very sure, or sure.
constexpr double kVerySure = 0.001, kSure = 0.01;

std::string SurenessText(const Finding& finding) {
  const std::size_t rivals = RivalsOf(finding).size();
  if (rivals > 0) {
    return fmt::format("Sure that something is wrong here, not which of {} causes it is.",
                       rivals + 1);
  }
  const double p = std::max(finding.evidence.p, finding.held_out.p);
  return p <= kVerySure ? "Very sure." : p <= kSure ? "Sure." : "Fairly sure.";
}

/// True if a set of the next manoeuvre consists of a cause and its rivals.
bool IsOf(const DiscriminatedSet& set, const Cause& cause) {
  return set.is_class && set.target == cause.target() &&
         std::find(set.members.begin(), set.members.end(), cause.mechanism().id) !=
             set.members.end();
}

std::string LabelsOf(const DiscriminatedSet& set) {
  std::vector<std::string> labels;
  for (const std::string& member : set.members) {
    const MechanismWords* words = WordsOf(member, set.target);
    labels.push_back(words == nullptr ? Spaced(member) : std::string(words->label));
  }
  return Listed(labels);
}

}  // namespace

std::string HowSureText(const Cause& cause) {
  std::string text = SurenessText(*cause.finding);
  if (cause.block != nullptr && IsLeft(*cause.block, cause.finding->location.channel)) {
    text += " Error is left beside it: do not trust the number yet.";
  }
  return text;
}

std::string WhatToDriveText(const Cause& cause, const Diagnosis& diagnosis) {
  if (RivalsOf(*cause.finding).empty()) return "";
  if (diagnosis.next) {
    const NextManoeuvre& next = *diagnosis.next;
    const auto told = std::find_if(next.discriminated.begin(), next.discriminated.end(),
                                   [&](const DiscriminatedSet& set) { return IsOf(set, cause); });
    if (told != next.discriminated.end()) {
      return fmt::format(
          "The levers in {} ({:.0f} s; {}) tell {} apart in {:.0f} of 100 recordings.",
          kNextManoeuvreFile, next.duration_s, next.description, LabelsOf(*told),
          100 * told->power);
    }
  }
  if (cause.block != nullptr && HasLever(cause.block->block)) {
    return "No levers were found that would tell these causes apart.";
  }
  return "Levers are worked out for joints, tracks and wheels alone. Record more driving with "
         "other "
         "headings, tilts and loads, or measure on the machine.";
}

}  // namespace tera
