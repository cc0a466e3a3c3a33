#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "diagnose/search/fit/replay_block.h"
#include "physics/description/machine.h"

namespace tera {

/// Collects candidate mechanisms of one target.
///
/// Model   a mechanism that the target already has may have wrong parameters. Its starts are its
///         present values, changed faintly first, and then those for a target without it. Its
///         bounds include the present values.
class CandidateList {
 public:
  /// The library must outlive the candidates.
  CandidateList(std::string target, EffectTarget kind, const Effects& present,
                std::span<const Mechanism> library)
      : target_(std::move(target)), kind_(kind), present_(present), library_(library) {}

  /// Adds a mechanism. The library must have `id` for this kind of target; `starts` are for a
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

/// The effects of a target, with `terms` replacing its own effects of the same mechanisms.
Effects WithTerms(Effects present, const Structure& terms);

/// The machine with `terms` on the base, joints, gears and pumps. Terms of sensors and poses are
/// ignored.
MachineModel WithTerms(MachineModel model, const Structure& terms);

}  // namespace tera
