#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "diagnose/search/fit/replay_block.h"
#include "physics/description/machine.h"

namespace tera {

/// Collects the mechanisms that are candidates for one target.
///
/// Model   a mechanism that the target has already may have wrong numbers: its starts are its
///         present numbers, changed faintly first, and then those for a target without it; its
///         bounds include the present numbers.
class CandidateList {
 public:
  /// The library must outlive the candidates.
  CandidateList(std::string target, EffectTarget kind, const Effects& present,
                std::span<const Mechanism> library)
      : target_(std::move(target)), kind_(kind), present_(present), library_(library) {}

  /// Adds a mechanism; `id` must be in the library for targets of that kind, `starts` are for a
  /// target without it. The reference is valid until the next call.
  Candidate& Add(std::string_view id, std::vector<FreeParameter> free,
                 std::vector<std::vector<double>> starts);
  std::vector<Candidate> Take() { return std::move(found_); }

 private:
  std::string target_;
  EffectTarget kind_;
  Effects present_;
  std::span<const Mechanism> library_;
  std::vector<Candidate> found_;
};

/// The effects of a target with `terms`, each in place of what the target has of its mechanism.
Effects WithTerms(Effects present, const Structure& terms);

/// The machine with `terms` on the base, joints, gears and pumps that they act on. Terms of sensors
/// and of anything else that is no part of the machine are ignored.
MachineModel WithTerms(MachineModel model, const Structure& terms);

}  // namespace tera
