#pragma once

#include <vector>

#include "physics/description/machine.h"

namespace tera {

/// Joint efforts that hold the weight of the links beyond each joint, at rest; 0 for fixed joints.
/// A positive effort pushes the joint towards larger positions.
///
/// Frames  The root has the pose `X_WB`; gravity acts along -z of W.
/// Model   Newton-Euler equations for links under gravity, held by the joints.
/// Omits   Soil in shovels, the ground, the weight of cylinders and linkages.
std::vector<double> GravityLoads_nm(const MachineModel& model, const Pose& X_WB,
                                    const std::vector<double>& q_rad);

}  // namespace tera
