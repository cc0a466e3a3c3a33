#pragma once

#include <vector>

#include "physics/description/machine.h"

namespace tera {

/// Inertia (or mass, of a joint that slides) that each joint moves when no other does: all links
/// beyond it, about its axis; 0 for fixed joints.
///
/// Model   the diagonal of the mass matrix of a machine whose root stands still.
/// Omits   coupling to other joints and the root; soil in shovels; cylinders and linkages.
std::vector<double> JointInertias_kgm2(const MachineModel& model, const std::vector<double>& q_rad);

/// Inertia of the whole machine against turning about the z axis of its root, through its centre of
/// mass.
double YawInertia_kgm2(const MachineModel& model, const std::vector<double>& q_rad);

}  // namespace tera
