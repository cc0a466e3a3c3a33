#pragma once

#include <vector>

#include "physics/description/machine.h"

namespace tera {

/// Inertia (mass for prismatic joints) about each joint's axis of all links beyond it, with all
/// other joints locked; 0 for fixed joints.
///
/// Model   The diagonal of the mass matrix of a machine with a fixed root.
/// Omits   Coupling to other joints and the root; soil in shovels; cylinders and linkages.
std::vector<double> JointInertias_kgm2(const MachineModel& model, const std::vector<double>& q_rad);

/// Yaw inertia of the whole machine about the axis through its centre of mass parallel to its
/// root's z axis.
double YawInertia_kgm2(const MachineModel& model, const std::vector<double>& q_rad);

}  // namespace tera
