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
/// Model   A mechanism that the target already has stays a candidate, because its parameters may be
///         wrong. The first starting values are small changes of the present values. The starting
///         values for a target without the mechanism follow. The bounds include the present values.
class CandidateList {
 public:
  /// `library` must outlive the candidates.
  CandidateList(std::string target, EffectTarget kind, const Effects& present,
                std::span<const Mechanism> library)
      : target_(std::move(target)), kind_(kind), present_(present), library_(library) {}

  /// Adds a mechanism. The library must have `id` for this kind of target. `starts` are for a
  /// target without the mechanism. The returned reference is valid until the next call.
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

/// Effects of a target with `terms`. A term replaces the effect of the same mechanism.
Effects WithTerms(Effects present, const Structure& terms);

/// The machine with the terms on its base, joints, gears and pumps. Terms of sensors and poses are
/// ignored.
MachineModel WithTerms(MachineModel model, const Structure& terms);

}  // namespace tera
