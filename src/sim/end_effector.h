#pragma once

#include <optional>

#include "core/motion.h"
#include "physics/description/machine.h"

namespace tera {

/// The tool of the ROS topics ee_pose and bucket_mass.
///
/// Frames  T: origin in the middle of the cutting edge (the tips of the teeth), axes of the link
///         that carries the shovel.
struct EndEffector {
  int shovel = 0;
  int link = 0;
  Pose X_BT = Pose::Identity();
};

/// The first shovel that can carry soil, or nothing.
std::optional<EndEffector> EndEffectorOf(const MachineModel& model);

}  // namespace tera
