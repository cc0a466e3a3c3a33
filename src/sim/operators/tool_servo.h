#pragma once

#include <optional>
#include <vector>

#include "physics/description/machine.h"

namespace tera {

/// Target of a tool frame F, relative to the machine's root link B.
struct ToolTarget {
  Vec3 p_BF_m = Vec3::Zero();
  std::optional<Mat3> R_BF;  ///< empty: any orientation
};

/// Joint rates that move frame F of the model towards `target`: one for each of `joints`, which are
/// indices into the model's joints.
///
/// Frames  B root link, F the frame.
/// Model   resolved-rate control. The wanted twist is the error over a time constant, limited to
///         kFastest_mps and kFastest_radps. The damped least-squares inverse of the frame's
///         Jacobian over `joints` converts it to joint rates. Then all rates are reduced by one
///         factor so that none exceeds its joint's rate at full lever. Motions that the joints
///         cannot make, such as the roll of a bucket, remain as an error.
/// Omits   joint limits, and obstacles on the way.
/// Source  Nakamura and Hanafusa 1986, "Inverse kinematic solutions with singularity robustness for
///         robot manipulator control"; Whitney 1969, "Resolved motion rate control".
std::vector<double> ToolRates(const MachineModel& model, const MachineState& state,
                              const NamedFrame& frame, const ToolTarget& target,
                              const std::vector<int>& joints);

}  // namespace tera
