#include "diagnose/report/text/sensor_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "diagnose/report/text/sentence.h"
#include "diagnose/report/text/words.h"

namespace tera {
namespace {

std::string TextOf(const SensorFound& found) {
  return fmt::format("{} of the {}", NameAndNumbers(found.finding),
                     Spaced(found.finding.term.candidate->target));
}

std::string ErrorText(const SensorFound& found) {
  if (found.unit.empty()) return "";
  const HeldOutError& error = found.finding.held_out;
  return fmt::format(" {}: RMSE {}.", Capitalised(QuantityOf(found.channel)),
                     Change(error.rmse_before, error.rmse_after, found.unit));
}

}  // namespace

std::vector<std::string> ComparedSensors(const DiagnosedSensors& sensors) {
  std::vector<std::string> names;
  for (const ChannelError& channel : sensors.estimate.channels) {
    const std::size_t first = channel.name.find('/') + 1;
    const std::string name = Spaced(channel.name.substr(first, channel.name.rfind('/') - first));
    if (names.empty() || names.back() != name) names.push_back(name);
  }
  return names;
}

std::string SentenceOf(const SensorFound& found) {
  const std::string what = Capitalised(TextOf(found));
  if (found.finding.parameters.empty()) {
    return fmt::format("{}: it counts against its lever and the inertial units.{}", what,
                       ErrorText(found));
  }
  const std::vector<std::string> alike = AlikeTexts(found.finding);
  return fmt::format(
      "{}, beyond tolerance ({} on parts of the recording that it was not fitted "
      "to{}).{}",
      what, ProbabilityText(found.finding.evidence.p),
      alike.empty() ? "" : "; not told apart from: " + Listed(alike), ErrorText(found));
}

std::string SentenceOfUnexplained(const std::vector<const ChannelError*>& left) {
  if (left.empty()) return "";
  std::vector<std::string> errors;
  for (const ChannelError* channel : left) {
    errors.push_back(fmt::format("{} {} (noise {})", QuantityOf(channel->name),
                                 Readable(channel->rms_after, channel->unit),
                                 Readable(channel->noise, channel->unit)));
  }
  return fmt::format("Error is left that no number of a sensor explains: {}.", Listed(errors));
}

std::vector<std::string> OtherSensorSentences(const DiagnosedSensors& sensors) {
  std::vector<std::string> sentences, within;
  for (const SensorFound& found : sensors.within_tolerance) within.push_back(TextOf(found));
  if (!within.empty()) {
    sentences.push_back(fmt::format("Within tolerance: {}.", Listed(within)));
  }
  for (const SensorFound& found : sensors.unconfirmed) {
    const std::string what = Capitalised(TextOf(found));
    const std::string p = ProbabilityText(found.finding.evidence.p);
    sentences.push_back(
        found.finding.is_confirmed
            ? fmt::format("{} was chosen ({}) and is not confirmed: what it changes is less than "
                          "noise, or less than half of what else is left.",
                          what, p)
            : fmt::format("{} would lie beyond tolerance, and is not confirmed: not all parts of "
                          "the recording bear it out alike ({}), or something else explains it.",
                          what, p));
  }
  for (const std::vector<TargetMechanism>& set : sensors.estimate.not_told_apart) {
    std::vector<std::string> names;
    for (const TargetMechanism& one : set) names.push_back(one.Name());
    sentences.push_back(fmt::format(
        "Not told apart, for their effects cancel: {}. None of them is named.", Listed(names)));
  }
  for (const std::string& obstacle : sensors.estimate.not_compared) {
    sentences.push_back(fmt::format("Not compared: {}.", obstacle));
  }
  return sentences;
}

namespace {

/// Centimetres for metres; pixels stay.
ReadableUnit UnitOf(const PerceptionDiagnosis& diagnosis) {
  return diagnosis.unit == "m" ? ReadableUnit{100, "cm"} : ReadableUnit{1, diagnosis.unit};
}

/// Simulated features that the sensor's data are compared with.
std::string_view SurfacesText(const PerceptionDiagnosis& diagnosis) {
  return diagnosis.unit == "m" ? "surfaces" : "edges";
}

/// ", 12–34 s and 1 more interval": the longest interval is named. Empty if the difference is
/// permanent.
std::string TimesText(const PerceptionFinding& found) {
  if (found.intervals_s.empty()) return "";
  const auto longest = *std::max_element(
      found.intervals_s.begin(), found.intervals_s.end(),
      [](const auto& a, const auto& b) { return a.second - a.first < b.second - b.first; });
  return ", " + IntervalsText(longest.first, longest.second, found.intervals_s.size() - 1);
}

double ValueOf(const PerceptionFinding& found, std::string_view name) {
  return Effect{found.finding.term.candidate->mechanism, found.finding.term.values}[name];
}

/// "at (4.0, -3.0) m, 3.5 x 3.6 m, 12–34 s".
std::string PlaceText(const PerceptionFinding& found) {
  const Vec2& at_m = found.place->centre_W_m;
  const Vec2 size_m = found.place->high_W_m - found.place->low_W_m;
  std::string text = fmt::format("at ({:.1f}, {:.1f}) m", at_m.x(), at_m.y());
  if (size_m.minCoeff() > 0) text += fmt::format(", {:.1f} x {:.1f} m", size_m.x(), size_m.y());
  return text + TimesText(found);
}

/// Difference of the scene, with place and time.
std::string SceneText(const PerceptionFinding& found) {
  const std::string_view id = found.finding.term.candidate->mechanism->id;
  if (id == "object_missing") {
    return fmt::format("{} {} is not there: {} of {:.0f} rays went on behind it",
                       found.finding.term.candidate->target, PlaceText(found),
                       PercentText(ValueOf(found, "share")), ValueOf(found, "rays"));
  }
  if (id == "dust") {
    return fmt::format("dust {}, up to {} m: {} of the rays that came through ended there",
                       PlaceText(found), Significant(ValueOf(found, "top_m"), 2),
                       PercentText(ValueOf(found, "stopped_share")));
  }
  const double mean_m = ValueOf(found, "mean_m");
  if (id == "object_added") {
    return fmt::format("a thing stands {}, which the scenario has not: up to {} m high",
                       PlaceText(found), Significant(ValueOf(found, "highest_m"), 2));
  }
  return fmt::format(
      "terrain height {}: {} m {} on average, {} to {} m, {} m³ of soil {} over {} m²",
      PlaceText(found), Significant(std::abs(mean_m), 2), mean_m < 0 ? "lower" : "higher",
      Significant(ValueOf(found, "lowest_m"), 2), Significant(ValueOf(found, "highest_m"), 2),
      Significant(std::abs(ValueOf(found, "volume_m3")), 2), mean_m < 0 ? "missing" : "more",
      Significant(ValueOf(found, "area_m2"), 2));
}

std::string WhatText(const PerceptionFinding& found) {
  return found.place ? SceneText(found) : NameAndNumbers(found.finding);
}

std::string SensorText(const PerceptionDiagnosis& diagnosis) {
  return Capitalised(Spaced(diagnosis.target));
}

std::string SentenceOfNothing(const PerceptionDiagnosis& diagnosis) {
  std::set<std::string> unseen;
  for (const ParameterDetectability& one : diagnosis.detectability) {
    const Mechanism& mechanism = *one.candidate->mechanism;
    if (!one.smallest) {
      unseen.insert(Spaced(mechanism.id) + " " +
                    WithoutUnit(mechanism.parameters[one.parameter].name));
    }
  }
  std::string text = fmt::format(
      "{}: nothing found; its {} {} lie within {} of the simulated {}.", SensorText(diagnosis),
      diagnosis.scans, diagnosis.unit == "m" ? "scans" : "pictures",
      Readable(diagnosis.noise_rmse, UnitOf(diagnosis)), SurfacesText(diagnosis));
  if (!unseen.empty()) {
    text += fmt::format(" It does not tell {}.", fmt::join(unseen, ", "));
  }
  return text;
}

}  // namespace

std::string SentenceOf(const PerceptionDiagnosis& diagnosis, const PerceptionFinding& found) {
  const HeldOutError& error = found.finding.held_out;
  std::string text = fmt::format("{}: {} ({}).", SensorText(diagnosis), WhatText(found),
                                 EvidenceClause(found.finding));
  // Missing objects and dust have no surface.
  if (error.rmse_after <= 0) return text;
  return text + fmt::format(" Held-out distance to the simulated {} {}.", SurfacesText(diagnosis),
                            Change(error.rmse_before, error.rmse_after, UnitOf(diagnosis)));
}

std::vector<std::string> PerceptionSentences(const std::vector<PerceptionDiagnosis>& sensors) {
  std::vector<std::string> sentences;
  for (const PerceptionDiagnosis& diagnosis : sensors) {
    for (const PerceptionFinding& found : diagnosis.findings) {
      sentences.push_back(SentenceOf(diagnosis, found));
    }
  }
  for (const PerceptionDiagnosis& diagnosis : sensors) {
    if (!diagnosis.is_judged()) {
      sentences.push_back(
          fmt::format("{}: not judged: {}.", SensorText(diagnosis), diagnosis.not_judged));
      continue;
    }
    for (const PerceptionFinding& found : diagnosis.unconfirmed) {
      sentences.push_back(fmt::format(
          "{}: {}, chosen with {}, was not confirmed ({}).", SensorText(diagnosis), WhatText(found),
          ProbabilityText(found.finding.evidence.p), ProbabilityText(found.finding.held_out.p)));
    }
    if (diagnosis.found_nothing() && diagnosis.unconfirmed.empty()) {
      sentences.push_back(SentenceOfNothing(diagnosis));
    }
  }
  return sentences;
}

}  // namespace tera
