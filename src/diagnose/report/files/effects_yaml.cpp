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
#include "diagnose/diagnosis.h"
#include "diagnose/report/text/sentence.h"
#include "diagnose/report/text/words.h"

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

/// A name as a key, in quotes if YAML could read the name as another type.
std::string Key(const std::string& name) {
  const bool begins_with_letter =
      !name.empty() && std::isalpha(static_cast<unsigned char>(name[0]));
  if (begins_with_letter && std::all_of(name.begin(), name.end(), IsPlain)) return name;
  std::string quoted = "'";
  for (const char c : name) quoted += c == '\'' ? std::string("''") : std::string(1, c);
  return quoted + "'";
}

/// A number as text. Rounding does not move it out of its range.
std::string Value(double value, const EffectParameter& parameter) {
  TERA_CHECK(std::isfinite(value), parameter.name);
  if (parameter.whole) return fmt::format("{:.0f}", value);
  const std::string rounded = fmt::format("{:.6g}", value);
  const double read = std::strtod(rounded.c_str(), nullptr);
  return read < parameter.lower || read > parameter.upper ? fmt::format("{}", value) : rounded;
}

const FreeParameter* FreeParameterOf(const Candidate& candidate, std::size_t index) {
  const auto at = std::find_if(candidate.free.begin(), candidate.free.end(),
                               [&](const FreeParameter& free) { return free.index == index; });
  return at != candidate.free.end() ? &*at : nullptr;
}

/// "dead_band: {width: 0.18}", with its rivals in a comment. A parameter is left out if a prior
/// kept it near the scenario's value.
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

/// Findings that a simulation can have, in the order of their ranks.
std::vector<const Finding*> EffectsFound(const Diagnosis& diagnosis) {
  std::vector<const Finding*> effects;
  for (const Cause& cause : RankedCauses(diagnosis)) {
    const bool is_of_scene = cause.seen != nullptr && cause.seen->place;
    if (cause.target() != kPoses && !is_of_scene) effects.push_back(cause.finding);
  }
  return effects;
}

/// Lines of a target. A target without lines is appended.
TargetLines* LinesOf(const std::string& target, std::vector<TargetLines>* targets) {
  auto at = std::find_if(targets->begin(), targets->end(),
                         [&](const TargetLines& lines) { return lines.target == target; });
  if (at == targets->end()) at = targets->insert(targets->end(), {target, {}, {}});
  return &*at;
}

std::string ListLine(std::string_view key, const std::vector<double>& values) {
  std::string text;
  for (const double value : values) {
    TERA_CHECK(std::isfinite(value), key);
    text += fmt::format("{}{:.6g}", text.empty() ? "" : ", ", value);
  }
  return fmt::format("  {}: [{}]", key, text);
}

/// The lines of a learned effect, with how well it holds in a comment.
std::vector<std::string> LearnedLines(const Learned& learned, const std::string& unit) {
  const LearnedEffect& effect = learned.effect;
  const ReadableUnit readable = ReadableUnitOf(unit);
  return {
      fmt::format(
          "learned:  # no name: what no mechanism explains. Held-out RMSE {} -> {} in the replay",
          Significant(learned.rmse_before * readable.factor, 2),
          Readable(learned.rmse_after, readable)),
      "  variable: " + Key(effect.variable.name),
      "  unit: " + effect.variable.unit,
      fmt::format("  as: {}", effect.is_share ? "share" : "added"),
      ListLine("at", effect.at),
      ListLine("value", effect.value),
      ListLine("low", effect.low),
      ListLine("high", effect.high)};
}

/// Comments on unexplained errors without a simulated effect, with the reason.
std::string NotLearnedText(const Diagnosis& diagnosis) {
  std::string text;
  for (const DiagnosedBlock& diagnosed : diagnosis.blocks) {
    for (const Unexplained& left : diagnosed.diagnosis.unexplained) {
      const std::size_t channel = left.location.channel;
      if (LearnedOf(diagnosed, channel) != nullptr) continue;
      const char* const reason =
          diagnosed.block.learnable.empty()
              ? "a simulation learns of joints, tracks and wheel sets alone, once each"
              : "no function of one variable that a simulation knows explains a twentieth of it";
      text += fmt::format("# What is left of the {} is not here: {}.\n",
                          QuantityOf(diagnosed.block.channels[channel].name), reason);
    }
  }
  return text;
}

std::vector<TargetLines> LinesOf(const std::vector<const Finding*>& findings) {
  std::vector<TargetLines> targets;
  for (const Finding* finding : findings) {
    const Candidate& candidate = *finding->term.candidate;
    TargetLines* at = LinesOf(candidate.target, &targets);
    const std::string_view id = candidate.mechanism->id;
    if (std::find(at->mechanisms.begin(), at->mechanisms.end(), id) != at->mechanisms.end())
      continue;
    at->mechanisms.push_back(id);
    at->lines.push_back(MechanismLine(*finding));
  }
  return targets;
}

void AddLearned(const Diagnosis& diagnosis, std::vector<TargetLines>* targets) {
  for (const DiagnosedBlock& diagnosed : diagnosis.blocks) {
    for (const Learned& learned : diagnosed.learned) {
      const std::string& unit = diagnosed.block.channels[learned.channel].unit;
      TargetLines* at = LinesOf(diagnosed.block.name, targets);
      for (std::string& line : LearnedLines(learned, unit)) {
        at->lines.push_back(std::move(line));
      }
    }
  }
}

std::string OnOneLine(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < 32 || c == 127; }, '?');
  return text;
}

std::string OverlayOf(const std::string& scenario, const std::vector<TargetLines>& targets) {
  if (targets.empty()) return "effects: {}\n";
  std::string text = fmt::format("effects:\n  {}:\n", Key(scenario));
  for (const TargetLines& target : targets) {
    text += fmt::format("    {}:\n", Key(target.target));
    for (const std::string& line : target.lines) text += fmt::format("      {}\n", line);
  }
  return text;
}

}  // namespace

std::string EffectsYaml(const Diagnosis& diagnosis, const std::string& recording) {
  std::vector<TargetLines> targets = LinesOf(EffectsFound(diagnosis));
  AddLearned(diagnosis, &targets);
  return fmt::format("# What the recording {} shows of {} beyond its simulation.\n",
                     OnOneLine(recording), OnOneLine(diagnosis.scenario)) +
         NotLearnedText(diagnosis) + OverlayOf(diagnosis.scenario, targets);
}

std::string EffectsYaml(const std::string& scenario, const std::vector<const Finding*>& findings,
                        const std::string& heading) {
  return fmt::format("# {}\n", OnOneLine(heading)) + OverlayOf(scenario, LinesOf(findings));
}

}  // namespace tera
