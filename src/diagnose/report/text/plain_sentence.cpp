#include "diagnose/report/text/plain_sentence.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <vector>

#include "core/check.h"
#include "diagnose/report/text/mechanism_words.h"
#include "diagnose/report/text/perception_text.h"
#include "diagnose/report/text/wording.h"

namespace tera {
namespace {

constexpr int kDigits = 2;  ///< of a number in a plain sentence
/// Standard deviations by which one of several numbers must differ from none to be told.
constexpr double kToldDeviations = 3;
constexpr double kSetAxis = 0.5;  ///< value from which on an axis of `axis_flip` is reversed

std::string Number(double value, const ReadableUnit& unit) {
  return WithUnit(Significant(value * unit.factor, kDigits), unit);
}

std::string Number(const ParameterEstimate& estimate) {
  return Number(estimate.value, ReadableUnitOf(estimate));
}

std::string Percents(double share) { return Significant(100 * std::abs(share), kDigits) + " %"; }

/// A place of a meaning, "offset_s:ahead:behind", taken apart.
struct Place {
  std::string_view name, above, below;
  char kind = ' ';        ///< the sign that separates the words, or # or ^
  bool percents = false;  ///< "%" behind the name
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
      return Number(value / (2 * std::numbers::pi), {1, "Hz"});
    case '^':
      return Number(1 / value, {1, "s"});
    default:
      return size;
  }
}

/// Whether a number clearly differs from what it is without the finding.
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

/// The fitted numbers of a finding by their names, those in `told` apart. Of several, those that
/// are clear.
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

/// The mechanism's values in the scenario, as a sentence of its own.
std::string PresentText(const Finding& finding) {
  const Candidate& candidate = *finding.term.candidate;
  std::vector<std::string> numbers;
  for (const FreeParameter& free : candidate.free) {
    if (candidate.present.empty() || finding.term.IsHeld(free.index)) continue;
    const ParameterEstimate& estimate = finding.parameters[free.index];
    numbers.push_back(WithoutUnit(estimate.name) + " " +
                      Number(candidate.present[free.index], ReadableUnitOf(estimate)));
  }
  return numbers.empty() ? "" : fmt::format(" The scenario has {} here.", Listed(numbers));
}

/// Indistinguishable rivals of a cause: "valve curve", "delay of the stamps of the sensor imu".
std::vector<std::string> RivalLabels(const Cause& cause) {
  std::vector<std::string> labels;
  for (const Candidate* rival : RivalsOf(*cause.finding)) {
    labels.emplace_back(WordsOf(rival->mechanism->id, rival->target)->label);
    if (rival->target != cause.target()) labels.back() += " of " + TargetText(*rival);
  }
  return labels;
}

/// The kind of a sensor in front of its name, as far as the mechanism tells it.
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
  if (cause.seen != nullptr && cause.seen->place) return PlainSceneText(*cause.seen);
  const MechanismWords* words = WordsOf(cause.mechanism().id, cause.target());
  TERA_CHECK(words != nullptr, cause.mechanism().id);
  return FilledIn(words->meaning, *cause.finding);
}

std::string FallText(const Cause& cause) {
  const HeldOutError& error = cause.finding->held_out;
  const std::string si_unit = cause.ErrorUnit();
  if (si_unit.empty() || error.rmse_after <= 0) return "";
  const bool is_distance = cause.seen_by != nullptr && si_unit == "m";
  const ReadableUnit unit = is_distance ? ReadableUnit{100, "cm"} : ReadableUnitOf(si_unit);
  const std::string on = cause.seen_by != nullptr ? "on measurements it had not seen"
                         : cause.sensor != nullptr
                             ? fmt::format("of the {}, over the whole recording,", cause.Quantity())
                             : "on driving it had not seen";
  const std::string before = Significant(error.rmse_before * unit.factor, kDigits);
  const std::string after = WithUnit(Significant(error.rmse_after * unit.factor, kDigits), unit);
  if (cause.block != nullptr && IsOfChance(cause.block->block, *cause.finding->term.candidate)) {
    return fmt::format(
        "With the last command held where the recording shows it, the error falls from {} to {}; "
        "which are lost next, nobody can predict.",
        before, after);
  }
  const std::string with = fmt::format("With this {} the error {}",
                                       WordsOf(cause.mechanism().id, cause.target())->label, on);
  if (error.rmse_after < error.rmse_before) {
    return fmt::format("{} falls from {} to {}.", with, before, after);
  }
  return fmt::format("{} does not fall, {} before and {} after, but most of it becomes likelier.",
                     with, before, after);
}

std::string ClassText(const Cause& cause) {
  const std::vector<std::string> rivals = RivalLabels(cause);
  if (rivals.empty()) return "";
  return fmt::format("Or it is {}: this recording does not tell.", fmt::join(rivals, " or "));
}

std::string HeadingOf(const Cause& cause) {
  std::string target = TargetText(*cause.finding->term.candidate).substr(4);
  std::vector<std::string> labels = RivalLabels(cause);
  labels.insert(labels.begin(), std::string(WordsOf(cause.mechanism().id, cause.target())->label));
  return fmt::format("{}: {}", Capitalised(std::move(target)), fmt::join(labels, " or "));
}

}  // namespace tera
