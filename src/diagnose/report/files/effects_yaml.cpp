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
#include "diagnose/report/text/by_weight.h"
#include "diagnose/report/text/finding_text.h"

namespace tera {
namespace {

/// What one target gets, in order of weight.
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

/// Within its range after rounding as before.
std::string Value(double value, const EffectParameter& parameter) {
  TERA_CHECK(std::isfinite(value), parameter.name);
  if (parameter.whole) return fmt::format("{:.0f}", value);
  const std::string rounded = fmt::format("{:.6g}", value);
  const double read = std::strtod(rounded.c_str(), nullptr);
  return read < parameter.lower || read > parameter.upper ? fmt::format("{}", value) : rounded;
}

/// The free parameter of that index, or nullptr.
const FreeParameter* FreeParameterOf(const Suspect& suspect, std::size_t index) {
  const auto at = std::find_if(suspect.free.begin(), suspect.free.end(),
                               [&](const FreeParameter& free) { return free.index == index; });
  return at != suspect.free.end() ? &*at : nullptr;
}

/// "dead_band: {width: 0.18}", and in a comment what it was not told apart from. A parameter that a
/// prior kept near what the simulation has is left out.
std::string MechanismLine(const Finding& finding) {
  const Suspect& suspect = *finding.term.suspect;
  std::vector<std::string> numbers;
  for (std::size_t i = 0; i < suspect.mechanism->parameters.size(); ++i) {
    const EffectParameter& parameter = suspect.mechanism->parameters[i];
    const double value = finding.term.values[i];
    const FreeParameter* free = FreeParameterOf(suspect, i);
    const bool has_already =
        suspect.present.empty() ? parameter.otherwise == value : suspect.present[i] == value;
    if ((free == nullptr || finding.term.IsHeld(i)) && has_already) continue;
    if (free != nullptr && free->prior_sigma > 0 && !IsTold(finding, *free)) continue;
    numbers.push_back(fmt::format("{}: {}", parameter.name, Value(value, parameter)));
  }
  const std::vector<std::string> alike = AlikeTexts(finding);
  const std::string comment =
      alike.empty() ? "" : fmt::format("  # or {}: not told apart", fmt::join(alike, ", "));
  return fmt::format("{}: {{{}}}{}", suspect.mechanism->id, fmt::join(numbers, ", "), comment);
}

/// All that was found and that a simulation can have, in order of weight.
std::vector<const Finding*> EffectsFound(const Diagnosis& diagnosis) {
  std::vector<const Finding*> effects;
  for (const auto& [diagnosed, finding] : FindingsByWeight(diagnosis)) {
    if (finding->term.suspect->target != kPoses) effects.push_back(finding);
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
    const Suspect& suspect = *finding->term.suspect;
    auto at = std::find_if(targets.begin(), targets.end(), [&](const TargetLines& lines) {
      return lines.target == suspect.target;
    });
    if (at == targets.end()) at = targets.insert(targets.end(), {suspect.target, {}, {}});
    const std::string_view id = suspect.mechanism->id;
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
