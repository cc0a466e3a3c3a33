#pragma once

#include <cstdint>
#include <vector>

#include "core/time.h"
#include "core/types/ground_tools.h"
#include "sim/world_state.h"

namespace tera {

/// What moves the machines of a world: physics, or a recording of how they moved.
class MotionSource {
 public:
  virtual ~MotionSource() = default;

  /// When a run starts, and with which step, whose number is negative where machines settle first.
  struct Begin {
    TimeNs start_ns = 0;
    std::int64_t first_step = 0;
  };
  /// Puts the machines into `world`, whose obstacles and ground are already where they are then.
  virtual void Start(const Begin& begin, WorldState* world) = 0;

  struct Step {
    TimeNs to_ns = 0;
    double dt_s = 0;
    const std::vector<SoilReaction>& reactions;  ///< of the ground, on each machine
  };
  /// Moves the machines of `world` from where they are at `world->t_ns` on by one step. Obstacles
  /// are already where they are at its end.
  virtual void Move(const Step& step, WorldState* world) = 0;

  /// Whether it is known where a machine is now. Where it is not, its tools leave the ground alone.
  virtual bool IsKnown(std::size_t machine) const = 0;
};

}  // namespace tera
