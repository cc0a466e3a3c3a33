#pragma once

#include <cstdint>
#include <vector>

#include "core/time.h"
#include "core/types/ground_tools.h"
#include "sim/world_state.h"

namespace tera {

/// Moves the machines of a world, by physics or by a recording.
class MotionSource {
 public:
  virtual ~MotionSource() = default;

  /// Start time and index of the first step, negative if machines settle first.
  struct Begin {
    TimeNs start_ns = 0;
    std::int64_t first_step = 0;
  };
  /// Places the machines into `world`, whose obstacles and ground are already at their start.
  virtual void Start(const Begin& begin, WorldState* world) = 0;

  struct Step {
    TimeNs to_ns = 0;
    double dt_s = 0;
    const std::vector<SoilReaction>& reactions;  ///< ground reaction on each machine
  };
  /// Moves the machines of `world` by one step from `world->t_ns`. Obstacles are already at the
  /// step's end.
  virtual void Move(const Step& step, WorldState* world) = 0;

  /// Whether the machine's current pose is known. Tools of an unknown machine leave the ground
  /// alone.
  virtual bool IsKnown(std::size_t machine) const = 0;
};

}  // namespace tera
