#pragma once

#include <vector>

#include "core/motion.h"
#include "physics/description/machine.h"

namespace tera {

/// Positions, rates and accelerations of all joints of a machine, including fixed ones. Unit: rad,
/// or m for prismatic joints.
struct JointMotions {
  std::vector<double> q, qd, qdd;
};

/// Motion of all links, given the motion of the root and the joints.
///
/// Frames  W; each link's motion is at its own origin.
/// Model   kinematics of a tree. J is the joint's frame, which moves with the parent link; n is the
///         joint's axis.
///         Revolute: w = w_J + n qd, alpha = alpha_J + n qdd + w_J x n qd.
///         Prismatic, with the offset r = n q: v = v_J + w_J x r + n qd, a = a_J + alpha_J x r +
///         w_J x (w_J x r) + 2 w_J x n qd + n qdd.
/// Source  Siciliano et al. 2009, "Robotics: modelling, planning and control", sec. 7.5 (forward
///         recursion of Newton-Euler).
std::vector<BodyState> MotionOfLinks(const MachineModel& model, const BodyState& root,
                                     const JointMotions& joints);

}  // namespace tera
