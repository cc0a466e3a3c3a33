#include "diagnose/report/files/effects_yaml.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <utility>
#include <vector>

#include "core/check.h"
#include "diagnose/blocks/measured_poses.h"
#include "diagnose/report/text/finding_text.h"
#include "diagnose/report/text/ranking.h"

namespace tera {
namespace {

/// The lines of one target, in the order of the findings' ranks.
struct TargetLines {
  std::string target;
  std::vector<std::string_view> mechanisms;
  std::vector<std::string> lines;
};

bool IsPlain(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         c == '/' || c == '-';
}

/// A name as a key: in quotes where it could be read as something else.
std::string Key(const std::string& name) {
  const bool begins_with_letter =
      !name.empty() && std::isalpha(static_cast<unsigned char>(name[0]));
  if (begins_with_letter && std::all_of(name.begin(), name.end(), IsPlain)) return name;
  std::string quoted = "'";
  for (const char c : name) quoted += c == '\'' ? std::string("''") : std::string(1, c);
  return quoted + "'";
}

/// A number as text, within its range after rounding as well as before.
std::string Value(double value, const EffectParameter& parameter) {
  TERA_CHECK(std::isfinite(value), parameter.name);
  if (parameter.whole) return fmt::format("{:.0f}", value);
  const std::string rounded = fmt::format("{:.6g}", value);
  const double read = std::strtod(rounded.c_str(), nullptr);
  return read < parameter.lower || read > parameter.upper ? fmt::format("{}", value) : rounded;
}

/// The free parameter of an index, or nullptr.
const FreeParameter* FreeParameterOf(const Candidate& candidate, std::size_t index) {
  const auto at = std::find_if(candidate.free.begin(), candidate.free.end(),
                               [&](const FreeParameter& free) { return free.index == index; });
  return at != candidate.free.end() ? &*at : nullptr;
}

/// "dead_band: {width: 0.18}", with its rivals in a comment. A parameter that a prior kept near the
/// simulation's number is omitted.
std::string MechanismLine(const Finding& finding) {
  const Candidate& candidate = *finding.term.candidate;
  std::vector<std::string> numbers;
  for (std::size_t i = 0; i < candidate.mechanism->parameters.size(); ++i) {
    const EffectParameter& parameter = candidate.mechanism->parameters[i];
    const double value = finding.term.values[i];
    const FreeParameter* free = FreeParameterOf(candidate, i);
    const bool has_already =
        candidate.present.empty() ? parameter.otherwise == value : candidate.present[i] == value;
    if ((free == nullptr || finding.term.IsHeld(i)) && has_already) continue;
    if (free != nullptr && free->prior_sigma > 0 && !IsReported(finding, *free)) continue;
    numbers.push_back(fmt::format("{}: {}", parameter.name, Value(value, parameter)));
  }
  const std::vector<std::string> alike = AlikeTexts(finding);
  const std::string comment =
      alike.empty() ? "" : fmt::format("  # or {}: not told apart", fmt::join(alike, ", "));
  return fmt::format("{}: {{{}}}{}", candidate.mechanism->id, fmt::join(numbers, ", "), comment);
}

/// The findings that a simulation can have, in the order of their ranks.
std::vector<const Finding*> EffectsFound(const Diagnosis& diagnosis) {
  std::vector<const Finding*> effects;
  for (const auto& [diagnosed, finding] : RankedFindings(diagnosis)) {
    if (finding->term.candidate->target != kPoses) effects.push_back(finding);
  }
  for (const SensorFound& found : diagnosis.sensors.findings) {
    if (found.finding.term.candidate->target != kPoses) effects.push_back(&found.finding);
  }
  for (const PerceptionDiagnosis& sensor : diagnosis.perception) {
    for (const PerceptionFinding& found : sensor.findings) {
      // What differs in the scene is no effect.
      if (!found.place) effects.push_back(&found.finding);
    }
  }
  return effects;
}

std::vector<TargetLines> LinesOf(const Diagnosis& diagnosis) {
  std::vector<TargetLines> targets;
  for (const Finding* finding : EffectsFound(diagnosis)) {
    const Candidate& candidate = *finding->term.candidate;
    auto at = std::find_if(targets.begin(), targets.end(), [&](const TargetLines& lines) {
      return lines.target == candidate.target;
    });
    if (at == targets.end()) at = targets.insert(targets.end(), {candidate.target, {}, {}});
    const std::string_view id = candidate.mechanism->id;
    if (std::find(at->mechanisms.begin(), at->mechanisms.end(), id) != at->mechanisms.end())
      continue;
    at->mechanisms.push_back(id);
    at->lines.push_back(MechanismLine(*finding));
  }
  return targets;
}

std::string OnOneLine(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < 32 || c == 127; }, '?');
  return text;
}

}  // namespace

std::string EffectsYaml(const Diagnosis& diagnosis, const std::string& recording) {
  std::string text = fmt::format("# What the recording {} shows of {} beyond its simulation.\n",
                                 OnOneLine(recording), OnOneLine(diagnosis.scenario));
  const std::vector<TargetLines> targets = LinesOf(diagnosis);
  if (targets.empty()) return text + "effects: {}\n";
  text += fmt::format("effects:\n  {}:\n", Key(diagnosis.scenario));
  for (const TargetLines& target : targets) {
    text += fmt::format("    {}:\n", Key(target.target));
    for (const std::string& line : target.lines) text += fmt::format("      {}\n", line);
  }
  return text;
}

}  // namespace tera
