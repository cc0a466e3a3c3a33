#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "core/motion.h"
#include "core/types/ground_tools.h"

/// Things on the site that do not give way, and which of them machines drive over.

namespace tera {

/// Boxes of an obstacle that stands or moves on the ground.
///
/// Frames  B the obstacle's.
struct RigidObstacle {
  struct Box {
    Pose X_BG = Pose::Identity();  ///< centre of the box
    Vec3 size_m = Vec3::Zero();    ///< edge lengths
  };
  std::vector<Box> boxes;
  /// Height of its highest corner over the ground where it stands.
  double rise_m = std::numeric_limits<double>::infinity();
};

/// The highest obstacle that a track or wheel rolls over: higher faces meet it too near its axle.
/// What is higher stops it.
inline double ClimbHeight_m(const RunningGear& gear) {
  constexpr double kShareOfRadius = 0.8;
  return kShareOfRadius * gear.drive_radius_m;
}

/// What all running gear on a link rolls over; 0 of a link without any.
inline double ClimbHeight_m(const std::vector<RunningGear>& gears, int link) {
  double least_m = std::numeric_limits<double>::infinity();
  for (const RunningGear& gear : gears) {
    if (gear.link == link) least_m = std::min(least_m, ClimbHeight_m(gear));
  }
  return least_m == std::numeric_limits<double>::infinity() ? 0 : least_m;
}

}  // namespace tera
