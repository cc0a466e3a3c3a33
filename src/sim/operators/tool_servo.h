#pragma once

#include <optional>
#include <vector>

#include "physics/description/machine.h"

namespace tera {

/// Target pose of a tool frame F relative to the machine's root link B.
struct ToolTarget {
  Vec3 p_BF_m = Vec3::Zero();
  std::optional<Mat3> R_BF;  ///< free if absent
};

/// Joint rates that move frame `frame` of the model towards `target`.
///
/// Frames  B root link, F the frame.
/// Model   resolved rates. The twist towards the target is error / time constant, limited to
///         kFastest_mps and kFastest_radps. It passes through the damped least-squares inverse of
///         the frame's Jacobian over `joints`. All rates are then scaled together so that none
///         exceeds its joint's rate at full lever. Motions that the joints cannot make (the roll of
///         an excavator's bucket) remain as an error.
/// Omits   joint limits and obstacles on the way.
/// Source  Nakamura and Hanafusa 1986, "Inverse kinematic solutions with singularity robustness for
///         robot manipulator control"; Whitney 1969, "Resolved motion rate control".
///
/// Returns one rate for each of `joints`, indices into the model's joints.
std::vector<double> ToolRates(const MachineModel& model, const MachineState& state,
                              const NamedFrame& frame, const ToolTarget& target,
                              const std::vector<int>& joints);

}  // namespace tera
