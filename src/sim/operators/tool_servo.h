#pragma once

#include <optional>
#include <vector>

#include "physics/description/machine.h"

namespace tera {

/// Where a tool frame F is wanted, relative to the machine's root link B.
struct ToolTarget {
  Vec3 p_BF_m = Vec3::Zero();
  std::optional<Mat3> R_BF;  ///< without it, any
};

/// Joint rates that take frame `frame` of the model towards `target`.
///
/// Frames  B root link, F the frame.
/// Model   resolved rates: the twist towards the target, error / time constant and no faster than
///         kFastest_mps and kFastest_radps, through the damped least-squares inverse of the
///         frame's Jacobian over `joints`; then all rates are scaled down together until none
///         exceeds its joint's own at full lever. What the joints cannot do (the roll of an
///         excavator's bucket) is left over.
/// Omits   joint limits and obstacles on the way.
/// Source  Nakamura and Hanafusa 1986, "Inverse kinematic solutions with singularity robustness for
///         robot manipulator control"; Whitney 1969, "Resolved motion rate control".
///
/// Returns one rate for each of `joints`, indices into the model's joints.
std::vector<double> ToolRates(const MachineModel& model, const MachineState& state,
                              const NamedFrame& frame, const ToolTarget& target,
                              const std::vector<int>& joints);

}  // namespace tera
