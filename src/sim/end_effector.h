#pragma once

#include <optional>

#include "core/motion.h"
#include "physics/description/machine.h"

namespace tera {

/// The tool that the ROS topics ee_pose and bucket_mass speak of.
///
/// Frames  T: origin in the middle of the cutting edge (the tips of the teeth), axes of the link
///         that carries the shovel.
struct EndEffector {
  int shovel = 0;
  int link = 0;
  Pose X_BT = Pose::Identity();
};

/// The first shovel that can carry soil; nothing where the machine has none.
std::optional<EndEffector> EndEffectorOf(const MachineModel& model);

}  // namespace tera
