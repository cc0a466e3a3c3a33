#pragma once

#include <cstddef>

#include "core/motion.h"

namespace tera {

/// Two bodies that press against each other in a step.
///
/// Frames  W.
struct BodyContact {
  enum class Kind { kMachine, kObstacle, kWall };
  struct Side {
    Kind kind = Kind::kMachine;
    std::size_t index = 0;  ///< of the machine or obstacle; 0 for walls
    int link = 0;           ///< of a machine

    auto operator<=>(const Side&) const = default;
  };
  Side a, b;
  Vec3 p_W_m = Vec3::Zero();      ///< mean of the contact points, weighted by force
  Vec3 force_W_n = Vec3::Zero();  ///< sum of the normal forces on a, mean over the step
};

}  // namespace tera
