#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "core/motion.h"
#include "core/types/ground_tools.h"

/// Rigid objects on the site, and the obstacle height that a machine can drive over.

namespace tera {

/// An obstacle on the ground, fixed or moving, as a set of boxes.
///
/// Frames  B obstacle frame, G box frame.
struct RigidObstacle {
  struct Box {
    Pose X_BG = Pose::Identity();  ///< pose of the box centre
    Vec3 size_m = Vec3::Zero();    ///< edge lengths
  };
  std::vector<Box> boxes;
  /// Height of the obstacle's highest corner above the ground at the obstacle's position.
  double rise_m = std::numeric_limits<double>::infinity();
};

/// Greatest obstacle height that a track or wheel climbs: 0.8 times its radius. The vertical face
/// of a higher obstacle meets the track or wheel near its axle and stops it.
inline double ClimbHeight_m(const RunningGear& gear) {
  constexpr double kShareOfRadius = 0.8;
  return kShareOfRadius * gear.drive_radius_m;
}

/// Greatest obstacle height that every track and wheel on the link climbs; 0 for a link without
/// any.
inline double ClimbHeight_m(const std::vector<RunningGear>& gears, int link) {
  double least_m = std::numeric_limits<double>::infinity();
  for (const RunningGear& gear : gears) {
    if (gear.link == link) least_m = std::min(least_m, ClimbHeight_m(gear));
  }
  return least_m == std::numeric_limits<double>::infinity() ? 0 : least_m;
}

}  // namespace tera
