#pragma once

#include <vector>

#include "sim/events/held_events.h"
#include "sim/scenario/scenario.h"
#include "sim/world_state.h"

namespace tera {

/// Circle that a machine can sweep.
struct SweptCircle {
  Vec3 axis_B_m = Vec3::Zero();  ///< a point of its axis in the root link
  double radius_m = 0;
};

/// Model   the axis is that of the root link's upright joint that reaches farthest, or the root's z
///         axis without one. The radius is that of an arm stretched out straight: the sum of the
///         distances from joint to joint and on to the farthest corner of a collision box. An arm
///         whose joints do not stretch it reaches less far. The circle also holds the root's own
///         boxes.
SweptCircle CircleOf(const MachineModel& model);

/// People within the reach of machines.
///
/// Model   person_near: the horizontal distance of a person's origin, between the feet, from the
///         axis of the machine's swept circle is less than its radius. The value is the least
///         distance between their collision boxes. It ends after 0.2 s outside.
/// Omits   machines and people without collision boxes.
class PersonEvents {
 public:
  /// Keeps a reference.
  explicit PersonEvents(const Scenario& scenario);

  void Observe(const Instant& now);
  std::vector<RecordedEvent> All() const { return near_.All(); }

 private:
  const Scenario& scenario_;
  std::vector<SweptCircle> circles_;  ///< of each machine
  std::vector<std::size_t> people_;   ///< indices of obstacles
  HeldEvents near_;
};

}  // namespace tera
