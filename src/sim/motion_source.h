#pragma once

#include <cstdint>
#include <vector>

#include "core/time.h"
#include "core/types/ground_tools.h"
#include "sim/world_state.h"

namespace tera {

/// Interface of a source of machine motion: physics or a recording.
class MotionSource {
 public:
  virtual ~MotionSource() = default;

  /// Start time, and the index of the first step: negative if machines settle before the start.
  struct Begin {
    TimeNs start_ns = 0;
    std::int64_t first_step = 0;
  };
  /// Places the machines in `world`. Its obstacles and ground are already in their initial state.
  virtual void Start(const Begin& begin, WorldState* world) = 0;

  struct Step {
    TimeNs to_ns = 0;
    double dt_s = 0;
    const std::vector<SoilReaction>& reactions;  ///< reaction of the ground on each machine
  };
  /// Moves the machines by one step from `world->t_ns`. Obstacles are already at the end of the
  /// step.
  virtual void Move(const Step& step, WorldState* world) = 0;

  /// False while a recording has no pose of the machine. Tools of such a machine leave the ground
  /// unchanged.
  virtual bool IsKnown(std::size_t machine) const = 0;
};

}  // namespace tera
