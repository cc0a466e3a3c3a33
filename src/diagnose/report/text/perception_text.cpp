#include "diagnose/report/text/perception_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "diagnose/report/text/wording.h"

namespace tera {
namespace {

constexpr double kClear = 3;  ///< standard deviations: a number that is told
constexpr double kCm = 100;

/// Metres in centimetres, pixels as they are.
std::string DistanceText(const PerceptionDiagnosis& diagnosis, double distance) {
  return Significant(diagnosis.unit == "m" ? kCm * distance : distance, 2);
}
std::string_view UnitText(const PerceptionDiagnosis& diagnosis) {
  return diagnosis.unit == "m" ? "cm" : "px";
}

/// What the sensor took, and what is compared with it.
std::string_view ScansText(const PerceptionDiagnosis& diagnosis) {
  return diagnosis.unit == "m" ? "scans" : "pictures";
}
std::string_view SurfacesText(const PerceptionDiagnosis& diagnosis) {
  return diagnosis.unit == "m" ? "surfaces" : "edges";
}

/// Whether a number is reported: the scans determine it, and it is not as it was.
bool IsReported(const PerceptionFinding& finding, std::size_t index) {
  const ParameterEstimate& estimate = finding.parameters[index];
  if (finding.parameters.size() == 1) return true;
  const double present = finding.present.empty() ? 0 : finding.present[index];
  return estimate.sigma && std::abs(estimate.value - present) > kClear * *estimate.sigma;
}

std::string NumberText(const PerceptionFinding& finding, std::size_t index) {
  const ParameterEstimate& estimate = finding.parameters[index];
  const ReadableUnit unit = ReadableUnitOf(estimate.unit);
  std::string text = WithUnit(WithSigma(estimate.value, estimate.sigma), unit);
  const double ideal = estimate.unit == "1" ? 1 : 0;
  if (!finding.present.empty() && finding.present[index] != ideal) {
    text += " instead of " + WithUnit(Significant(finding.present[index], 4), unit);
  }
  return finding.parameters.size() == 1 ? text : WithoutUnit(estimate.name) + " " + text;
}

std::string TimesText(const PerceptionFinding& finding) {
  if (finding.intervals_s.empty()) return "";
  const auto longest = *std::max_element(
      finding.intervals_s.begin(), finding.intervals_s.end(),
      [](const auto& a, const auto& b) { return a.second - a.first < b.second - b.first; });
  const double span_s = longest.second - longest.first;
  std::string text =
      fmt::format(", {}–{} s", TimeText(longest.first, span_s), TimeText(longest.second, span_s));
  const std::size_t more = finding.intervals_s.size() - 1;
  if (more > 0) text += fmt::format(" and {} more interval{}", more, more == 1 ? "" : "s");
  return text;
}

double ValueOf(const PerceptionFinding& finding, std::string_view name) {
  for (const ParameterEstimate& estimate : finding.parameters) {
    if (estimate.name == name) return estimate.value;
  }
  return 0;
}

/// "the ground at (4.0, -3.0) m, 3.5 x 3.6 m".
std::string PlaceText(const PerceptionFinding& finding) {
  const Vec2& at_m = finding.place->centre_W_m;
  const Vec2 size_m = finding.place->high_W_m - finding.place->low_W_m;
  std::string text = fmt::format("at ({:.1f}, {:.1f}) m", at_m.x(), at_m.y());
  if (size_m.minCoeff() > 0) text += fmt::format(", {:.1f} x {:.1f} m", size_m.x(), size_m.y());
  return text + TimesText(finding);
}

/// What is elsewhere on the site than simulated.
std::string SceneText(const PerceptionFinding& finding) {
  if (finding.mechanism == "object_missing") {
    return fmt::format("{} {} is not there: {} of {:.0f} rays went on behind it", finding.target,
                       PlaceText(finding), PercentText(ValueOf(finding, "share")),
                       ValueOf(finding, "rays"));
  }
  if (finding.mechanism == "dust") {
    return fmt::format("dust {}, up to {} m: {} of the rays that came through ended there",
                       PlaceText(finding), Significant(ValueOf(finding, "top_m"), 2),
                       PercentText(ValueOf(finding, "stopped_share")));
  }
  const double mean_m = ValueOf(finding, "mean_m");
  if (finding.mechanism == "object_added") {
    return fmt::format("a thing stands {}, which the scenario has not: up to {} m high",
                       PlaceText(finding), Significant(ValueOf(finding, "highest_m"), 2));
  }
  return fmt::format(
      "terrain height {}: {} m {} on average, {} to {} m, {} m³ of soil {} over {} m²",
      PlaceText(finding), Significant(std::abs(mean_m), 2), mean_m < 0 ? "lower" : "higher",
      Significant(ValueOf(finding, "lowest_m"), 2), Significant(ValueOf(finding, "highest_m"), 2),
      Significant(std::abs(ValueOf(finding, "volume_m3")), 2), mean_m < 0 ? "missing" : "more",
      Significant(ValueOf(finding, "area_m2"), 2));
}

std::string WhatText(const PerceptionFinding& finding) {
  return finding.place ? SceneText(finding) : NameAndNumbers(finding);
}

std::string RivalsClause(const PerceptionFinding& finding) {
  if (finding.rivals.size() < 2) return "";
  std::vector<std::string> others;
  for (std::size_t r = 1; r < finding.rivals.size(); ++r) {
    others.push_back(Spaced(finding.rivals[r]));
  }
  return fmt::format("; {} would do as well", fmt::join(others, " or "));
}

std::string SensorText(const PerceptionDiagnosis& diagnosis) {
  return Capitalised(Spaced(diagnosis.target));
}

std::string SentenceOfNothing(const PerceptionDiagnosis& diagnosis) {
  std::set<std::string> unseen;
  for (const SensorDetectability& one : diagnosis.sensor.detectability) {
    if (!one.smallest) {
      unseen.insert(Spaced(one.mechanism) + " " + WithoutUnit(one.parameter));
    }
  }
  std::string text = fmt::format(
      "{}: nothing found; its {} {} lie within {} {} of the simulated {}.", SensorText(diagnosis),
      diagnosis.scans, ScansText(diagnosis), DistanceText(diagnosis, diagnosis.sensor.noise_rmse),
      UnitText(diagnosis), SurfacesText(diagnosis));
  if (!unseen.empty()) {
    text += fmt::format(" It does not tell {}.", fmt::join(unseen, ", "));
  }
  return text;
}

}  // namespace

std::string NameAndNumbers(const PerceptionFinding& finding) {
  std::vector<std::string> numbers;
  for (std::size_t i = 0; !finding.place && i < finding.parameters.size(); ++i) {
    if (IsReported(finding, i)) numbers.push_back(NumberText(finding, i));
  }
  const std::string name = Spaced(finding.mechanism);
  return numbers.empty() ? name : fmt::format("{} {}", name, fmt::join(numbers, ", "));
}

std::string SentenceOf(const PerceptionDiagnosis& diagnosis, const PerceptionFinding& finding) {
  std::string text =
      fmt::format("{}: {} (chosen with {}, confirmed with {}{}).", SensorText(diagnosis),
                  WhatText(finding), ProbabilityText(finding.p_chosen),
                  ProbabilityText(finding.p_confirmed), RivalsClause(finding));
  // Of what is not there, or in the air, there is no surface.
  if (finding.rmse_after <= 0) return text;
  return text + fmt::format(" Held-out distance to the simulated {} {} → {} {}.",
                            SurfacesText(diagnosis), DistanceText(diagnosis, finding.rmse_before),
                            DistanceText(diagnosis, finding.rmse_after), UnitText(diagnosis));
}

std::vector<std::string> PerceptionSentences(const std::vector<PerceptionDiagnosis>& sensors) {
  std::vector<std::string> sentences;
  for (const PerceptionDiagnosis& diagnosis : sensors) {
    for (const PerceptionFinding& finding : diagnosis.findings) {
      sentences.push_back(SentenceOf(diagnosis, finding));
    }
  }
  for (const PerceptionDiagnosis& diagnosis : sensors) {
    if (!diagnosis.is_judged()) {
      sentences.push_back(
          fmt::format("{}: not judged: {}.", SensorText(diagnosis), diagnosis.not_judged));
      continue;
    }
    for (const PerceptionFinding& finding : diagnosis.unconfirmed) {
      sentences.push_back(fmt::format("{}: {}, chosen with {}, was not confirmed ({}).",
                                      SensorText(diagnosis), WhatText(finding),
                                      ProbabilityText(finding.p_chosen),
                                      ProbabilityText(finding.p_confirmed)));
    }
    if (diagnosis.found_nothing() && diagnosis.unconfirmed.empty()) {
      sentences.push_back(SentenceOfNothing(diagnosis));
    }
  }
  return sentences;
}

std::string EffectLine(const PerceptionFinding& finding) {
  std::vector<std::string> numbers;
  for (std::size_t i = 0; i < finding.parameters.size(); ++i) {
    if (!IsReported(finding, i)) continue;
    numbers.push_back(
        fmt::format("{}: {:.6g}", finding.parameters[i].name, finding.parameters[i].value));
  }
  return fmt::format("{}: {{{}}}", finding.mechanism, fmt::join(numbers, ", "));
}

}  // namespace tera
