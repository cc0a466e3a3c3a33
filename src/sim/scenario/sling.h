#pragma once

#include <limits>
#include <vector>

#include "core/config/config.h"
#include "core/motion.h"

namespace tera {

/// Ropes from one hook of a machine to one or more points of a dynamic obstacle.
///
/// Frames  B the hook's link; T the obstacle.
/// Model   each leg is a massless rope that only pulls: a spring beyond its length. The load's
///         weight stretches one leg by 1 %. Damping is a tenth of critical.
/// Omits   the rope's mass, its contact with ground and machine, and its picture.
struct Sling {
  std::size_t machine = 0, obstacle = 0;  ///< indices in the scenario
  int link = 0;
  Vec3 hook_B_m = Vec3::Zero();
  std::vector<Vec3> points_T_m;                              ///< a leg leads to each
  double length_m = 1;                                       ///< of each leg
  double from_s = -std::numeric_limits<double>::infinity();  ///< attached from the settling on
  double until_s = std::numeric_limits<double>::infinity();
};

/// Adds the forces of the legs at the present motion of both ends. `load_kg` is the obstacle's
/// mass.
void Pull(const Sling& sling, double load_kg, const BodyState& link, const BodyState& obstacle,
          Wrench* on_link, Wrench* on_obstacle);

}  // namespace tera
