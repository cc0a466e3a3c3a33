#include "diagnose/candidates/candidate_library.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/config/config.h"
#include "core/config/spelling.h"
#include "core/error.h"
#include "diagnose/blocks/measured_poses.h"
#include "diagnose/search/fit/structure_fit.h"
#include "physics/actuation/actuation_mechanisms.h"
#include "physics/traction/ground_mechanisms.h"
#include "sensors/sensor_mechanisms.h"

namespace tera {
namespace {

/// Positions in a new range at which fits start, from faint to strong.
constexpr double kLadder[] = {0.1, 0.3, 0.6, 0.9};

constexpr const char* kFormerKey = "suspects";  ///< synonym of "candidates"

std::vector<const Mechanism*> AllMechanisms() {
  std::vector<const Mechanism*> all;
  for (const auto library :
       {ActuationMechanisms(), GroundMechanisms(), SensorMechanisms(), PoseMechanisms()}) {
    for (const Mechanism& mechanism : library) all.push_back(&mechanism);
  }
  return all;
}

std::vector<std::string> Identifiers() {
  std::vector<std::string> names;
  for (const Mechanism* mechanism : AllMechanisms()) names.emplace_back(mechanism->id);
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

bool IsMechanism(const ConfigMap& config, std::string_view key, const std::string& id) {
  const std::vector<std::string> names = Identifiers();
  if (std::find(names.begin(), names.end(), id) != names.end()) return true;
  config.Fault(key, {FaultKind::kNoSuchName,
                     fmt::format("'{}' is no mechanism{}; docs/reference/mechanisms.md lists them",
                                 id, DidYouMean(id, names))});
  return false;
}

std::vector<std::string> ReadIdentifiers(const ConfigMap& config, std::string_view key) {
  std::vector<std::string> names;
  if (!config.Has(key)) return names;
  for (const std::string& id : config.Texts(key)) {
    if (IsMechanism(config, key, id)) names.push_back(id);
  }
  if (config.Texts(key).empty()) {
    config.Fault(key, {FaultKind::kMissing,
                       fmt::format("is empty; need a mechanism in it, or no '{}'", key)});
  }
  return names;
}

/// The range of one parameter, if the mapping has it.
std::optional<NumberRange> ReadRange(const ConfigMap& config, const EffectParameter& parameter,
                                     std::size_t index) {
  if (!config.Has(parameter.name)) return std::nullopt;
  const Range within = Between(parameter.lower, parameter.upper, std::string(parameter.unit));
  if (!config.IsList(parameter.name)) {
    const double value = config.Number(parameter.name, within);
    return NumberRange{index, value, value};
  }
  const std::vector<double> ends = config.Numbers(parameter.name, within, 2, 2);
  if (ends.size() != 2) return std::nullopt;
  if (!(ends[0] < ends[1])) {
    config.Fault(parameter.name, fmt::format("the range from {} to {} is empty; need the lower end "
                                             "first, or one number to hold it there",
                                             ends[0], ends[1]));
    return std::nullopt;
  }
  return NumberRange{index, ends[0], ends[1]};
}

/// Several mechanisms may share an identifier and differ by target. Each gets the ranges of its
/// parameters.
void ReadRanges(const ConfigMap& config, const std::string& id, CandidateLibrary* library) {
  for (const Mechanism* mechanism : AllMechanisms()) {
    if (mechanism->id != id) continue;
    std::vector<NumberRange> ranges;
    for (std::size_t i = 0; i < mechanism->parameters.size(); ++i) {
      if (const auto range = ReadRange(config, mechanism->parameters[i], i)) {
        ranges.push_back(*range);
      }
    }
    library->ranges.emplace_back(mechanism, std::move(ranges));
  }
}

bool Holds(const std::vector<std::string>& names, std::string_view id) {
  return std::find(names.begin(), names.end(), id) != names.end();
}

/// Length of a range: a difference, or the logarithm of the ratio for a logarithmic parameter.
double SpanOf(const FreeParameter& free) {
  return free.logarithmic ? std::log(free.upper / free.lower) : free.upper - free.lower;
}

/// Restricts a candidate's parameter to a range, or holds it if the range is a single value.
void Limit(const NumberRange& range, Candidate* candidate) {
  FreeParameter limited = {.index = range.index, .lower = range.lower, .upper = range.upper};
  std::erase_if(candidate->free, [&](const FreeParameter& free) {
    if (free.index != range.index) return false;
    limited.logarithmic = free.logarithmic && range.lower > 0;
    // `kink` is relative to the range, so that it grows as the range shrinks.
    limited.kink = std::min(1.0, free.kink * SpanOf(free) / SpanOf(limited));
    return true;
  });
  if (range.lower < range.upper) {
    candidate->free.insert(candidate->free.begin() + static_cast<std::ptrdiff_t>(std::min(
                                                         range.index, candidate->free.size())),
                           limited);
  }
  std::vector<std::vector<double>> starts;
  for (std::vector<double> start : candidate->starts) {
    start[range.index] = std::clamp(start[range.index], range.lower, range.upper);
    if (std::find(starts.begin(), starts.end(), start) == starts.end()) starts.push_back(start);
  }
  candidate->starts = std::move(starts);
}

/// A candidate that the block does not have. Its starts are spread over the first range.
Candidate NewCandidate(const Mechanism& mechanism, const std::vector<NumberRange>& ranges,
                       const std::string& target, const std::string& file) {
  std::vector<std::optional<NumberRange>> by_number(mechanism.parameters.size());
  for (const NumberRange& range : ranges) by_number[range.index] = range;
  Candidate candidate{&mechanism, target, {}, {}, {}};
  for (const double place : kLadder) {
    std::vector<double> start;
    bool is_first = true;
    for (std::size_t i = 0; i < mechanism.parameters.size(); ++i) {
      const EffectParameter& parameter = mechanism.parameters[i];
      if (!by_number[i] && !parameter.otherwise) {
        throw InputError(file, fmt::format("candidates.{}: needs a range for {}, which has no "
                                           "default and no range of its own on {}",
                                           mechanism.id, parameter.name, target));
      }
      if (!by_number[i]) {
        start.push_back(*parameter.otherwise);
        continue;
      }
      const bool is_free = by_number[i]->lower < by_number[i]->upper;
      start.push_back(
          std::lerp(by_number[i]->lower, by_number[i]->upper, is_free && is_first ? place : 0.5));
      is_first = is_first && !is_free;
    }
    if (candidate.starts.empty() || candidate.starts.back() != start)
      candidate.starts.push_back(start);
  }
  for (const NumberRange& range : ranges) {
    if (range.lower < range.upper)
      candidate.free.push_back({range.index, range.lower, range.upper});
  }
  return candidate;
}

bool IsOfReceivers(const ReplayBlock& block) {
  if (block.candidates.empty()) return false;
  return std::all_of(
      block.candidates.begin(), block.candidates.end(),
      [](const Candidate& candidate) { return candidate.mechanism->ActsOn(EffectTarget::kGnss); });
}

/// The kind of a target. None for measured poses, which only have candidates of their own.
std::optional<EffectTarget> KindOf(const MachineModel& model, const ReplayBlock& block,
                                   const std::string& target) {
  if (target == kPoses) return std::nullopt;
  if (target == "base") return EffectTarget::kBase;
  if (model.JointIndex(target) >= 0) return EffectTarget::kJoint;
  for (const RunningGear& gear : model.ground_tools.gears) {
    if (gear.name == target) return EffectTarget::kGear;
  }
  for (const Pump& pump : model.pumps) {
    if (pump.name == target) return EffectTarget::kPump;
  }
  return IsOfReceivers(block) ? EffectTarget::kGnss : EffectTarget::kImu;
}

/// Targets of a block's candidates; the block itself if it has none.
std::vector<std::string> TargetsOf(const ReplayBlock& block) {
  if (block.candidates.empty()) return {block.name};
  std::vector<std::string> targets;
  for (const Candidate& candidate : block.candidates) {
    if (!Holds(targets, candidate.target)) targets.push_back(candidate.target);
  }
  return targets;
}

}  // namespace

CandidateLibrary ReadCandidateLibrary(const std::filesystem::path& file) {
  const Config config = Config::FromFile(file);
  const ConfigMap root = config.root();
  CandidateLibrary library{
      file.string(), ReadIdentifiers(root, "only"), ReadIdentifiers(root, "without"), {}};
  const bool has_former_key = root.Has(kFormerKey) && !root.Has("candidates");
  const char* const key = has_former_key ? kFormerKey : "candidates";
  for (const auto& [id, map] : root.NamedMaps(key)) {
    if (!IsMechanism(root.Map(key), id, id)) continue;
    ReadRanges(map, id, &library);
  }
  config.Finish();
  return library;
}

bool Admits(const CandidateLibrary& library, std::string_view mechanism) {
  return !Holds(library.without, mechanism) &&
         (library.only.empty() || Holds(library.only, mechanism));
}

void ApplyLibrary(const CandidateLibrary& library, const MachineModel& model,
                  std::vector<ReplayBlock>* blocks) {
  for (ReplayBlock& block : *blocks) {
    const std::vector<std::string> targets = TargetsOf(block);
    for (const auto& [mechanism, ranges] : library.ranges) {
      bool is_own = false;
      for (std::vector<Candidate>* candidates : {&block.candidates, &block.of_chance}) {
        for (Candidate& candidate : *candidates) {
          if (candidate.mechanism != mechanism) continue;
          for (const NumberRange& range : ranges) Limit(range, &candidate);
          is_own = true;
        }
      }
      for (const std::string& target : targets) {
        const auto kind = KindOf(model, block, target);
        if (is_own || !kind || !mechanism->ActsOn(*kind)) continue;
        block.candidates.push_back(NewCandidate(*mechanism, ranges, target, library.file));
      }
    }
    for (std::vector<Candidate>* candidates : {&block.candidates, &block.of_chance}) {
      std::erase_if(*candidates, [&](const Candidate& candidate) {
        return !Admits(library, candidate.mechanism->id);
      });
    }
  }
}

void RequireCandidates(const CandidateLibrary& library, const std::vector<ReplayBlock>& blocks) {
  const bool any = std::any_of(blocks.begin(), blocks.end(),
                               [](const ReplayBlock& block) { return !block.candidates.empty(); });
  if (any) return;
  throw InputError(library.file,
                   fmt::format("leaves no candidate for what this recording has ({} blocks); need "
                               "an identifier of a mechanism that can act there",
                               blocks.size()));
}

}  // namespace tera
