#pragma once

#include <vector>

#include "core/motion.h"
#include "physics/description/machine.h"

namespace tera {

/// Pose and velocities of a machine's root link in W.
struct RootMotion {
  Pose X_WB = Pose::Identity();
  Vec3 v_WB_mps = Vec3::Zero(), w_WB_radps = Vec3::Zero();
};

/// Moves all links to the root state `root` and the joint positions `q_rad` with rates `qd_radps`
/// (m and m/s for prismatic joints), over a step of `dt_s`. With dt_s = 0 accelerations stay
/// unchanged.
///
/// Frames  W.
/// Model   Poses and velocities by forward kinematics; accelerations are the change of velocity
///         over `dt_s`.
void MoveLinks(const MachineModel& model, const RootMotion& root, const std::vector<double>& q_rad,
               const std::vector<double>& qd_radps, double dt_s, std::vector<BodyState>* links);

}  // namespace tera
