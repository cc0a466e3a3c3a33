#pragma once

#include <vector>

#include "physics/description/machine.h"
#include "sim/events/held_events.h"
#include "sim/scenario/scenario.h"
#include "sim/world_state.h"

namespace tera {

/// Machines that lose their footing.
///
/// Model   tip: the vertical through the centre of mass, with the shovels' loads, leaves the convex
///         hull of the running gear's flat underside, seen from above; `part` is then the root
///         link. Or no patch of a track or wheel set bears on the ground or on an obstacle for a
///         tenth of a second; `part` is then that gear. The value is the largest lean: the angle
///         between the root link's z axis and the vertical.
/// Omits   support by blade, bucket and structure; inertial forces (static limit).
/// Source  McGhee and Frank 1968, Mathematical Biosciences 3.
class TipEvents {
 public:
  /// Keeps a reference.
  explicit TipEvents(const Scenario& scenario);

  void Observe(const Instant& now);
  std::vector<RecordedEvent> All() const;

 private:
  /// Whether the centre of mass is above its running gear.
  bool IsStable(std::size_t machine, const MachineState& state) const;

  const Scenario& scenario_;
  std::vector<MachineModel> models_;  ///< with payloads
  HeldEvents beyond_, lifted_;
};

}  // namespace tera
