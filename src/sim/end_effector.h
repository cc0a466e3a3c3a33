#pragma once

#include <optional>

#include "core/motion.h"
#include "physics/description/machine.h"

namespace tera {

/// The tool that the ROS topics ee_pose and bucket_mass describe.
///
/// Frames  T: origin at the middle of the cutting edge (the tips of the teeth), axes of the
///         shovel's link.
struct EndEffector {
  int shovel = 0;
  int link = 0;
  Pose X_BT = Pose::Identity();
};

/// The first shovel that can carry soil; empty if there is none.
std::optional<EndEffector> EndEffectorOf(const MachineModel& model);

}  // namespace tera
