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

/// Moves all links on by a step of `dt_s`, after which the root is at `root` and the joints at
/// `q_rad` with the rates `qd_radps` (m and m/s where they slide). Without time, dt_s = 0,
/// accelerations stay as they are.
///
/// Frames  W.
/// Model   poses and velocities by forward kinematics; accelerations are those that lead from the
///         velocities before the step to the ones after it.
void MoveLinks(const MachineModel& model, const RootMotion& root, const std::vector<double>& q_rad,
               const std::vector<double>& qd_radps, double dt_s, std::vector<BodyState>* links);

}  // namespace tera
