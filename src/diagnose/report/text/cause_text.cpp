#include "diagnose/report/text/cause_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/check.h"
#include "diagnose/diagnosis.h"
#include "diagnose/report/text/sentence.h"
#include "diagnose/report/text/words.h"

namespace tera {
namespace {

constexpr int kDigits = 2;        ///< of a number in a plain sentence
constexpr double kSetAxis = 0.5;  ///< value from which on an axis of `axis_flip` is reversed

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

/// "valve curve", and on another target than what was found "delay of the stamps of the sensor
/// imu".
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
  std::string text;
  while (!meaning.empty()) {
    const auto open = meaning.find('{');
    text += meaning.substr(0, open);
    if (open == meaning.npos) break;
    const auto close = meaning.find('}', open);
    const Place place = PlaceOf(meaning.substr(open + 1, close - open - 1));
    meaning.remove_prefix(close + 1);
    text += place.name == "The"       ? Capitalised(target)
            : place.name == "the"     ? target
            : place.name == "axes"    ? AxesText(finding)
            : place.name == "numbers" ? NumbersText(finding)
                                      : NumberAt(place, EstimateAt(place.name, finding));
  }
  return text;
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

}  // namespace

std::string HowSureText(const Cause& cause) {
  std::string text = SurenessText(*cause.finding);
  if (cause.block != nullptr && IsLeft(*cause.block, cause.finding->location.channel)) {
    text += " Error is left beside it: do not trust the number yet.";
  }
  return text;
}

}  // namespace tera
