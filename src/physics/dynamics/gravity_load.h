#pragma once

#include <vector>

#include "physics/description/machine.h"

namespace tera {

/// Effort of each joint that bears the weight of the links beyond it, at rest; 0 for fixed joints.
/// Positive where the joint must be pushed towards larger positions.
///
/// Frames  The root stands at `X_WB`; gravity acts along -z of W.
/// Model   Newton and Euler for every link that gravity accelerates and the joints hold.
/// Omits   soil in shovels, the ground, the weight of cylinders and linkages.
std::vector<double> GravityLoads_nm(const MachineModel& model, const Pose& X_WB,
                                    const std::vector<double>& q_rad);

}  // namespace tera
