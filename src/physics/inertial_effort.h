#pragma once

#include <vector>

#include "physics/machine.h"

namespace tera {

/// Part of each joint's effort that accelerates the links beyond it and the soil they carry; 0 for
/// fixed joints.
///
/// Model   Newton and Euler for every link, with the accelerations of `state`, summed from the tips
///         to the joint: what is left of the joint's effort bears weight, ground and contacts.
///         Carried soil is a point mass.
std::vector<double> InertialEfforts(const MachineModel& model, const MachineState& state);

}  // namespace tera
