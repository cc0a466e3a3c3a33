#pragma once

#include <limits>
#include <vector>

#include "core/config/config.h"
#include "core/motion.h"

namespace tera {

/// Ropes from one hook on a machine to one or more points of a dynamic obstacle.
///
/// Frames  B is the hook's link; T is the obstacle.
/// Model   each rope is massless and acts as a spring once it is taut. Its stiffness is such that
///         the load's whole weight stretches one rope by 1 %. Damping is a tenth of critical.
/// Omits   the rope's mass, its contact with ground and machine, and its picture.
struct Sling {
  std::size_t machine = 0, obstacle = 0;  ///< indices in the scenario
  int link = 0;
  Vec3 hook_B_m = Vec3::Zero();
  std::vector<Vec3> points_T_m;  ///< one rope leads to each point
  double length_m = 1;           ///< of each rope when slack
  /// Start of attachment; by default attached during the settling, too.
  double from_s = -std::numeric_limits<double>::infinity();
  double until_s = std::numeric_limits<double>::infinity();
};

/// Adds the forces of the ropes for the current motion of both ends. `load_kg` is the obstacle's
/// mass.
void Pull(const Sling& sling, double load_kg, const BodyState& link, const BodyState& obstacle,
          Wrench* on_link, Wrench* on_obstacle);

}  // namespace tera
