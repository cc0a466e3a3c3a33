#pragma once

#include <vector>

#include "sim/events/held_events.h"
#include "sim/scenario/scenario.h"
#include "sim/world_state.h"

namespace tera {

/// Free falls of things that forces move.
///
/// Model   drop: the centre of mass accelerates downwards by more than 0.9 g. The value is its
///         height above its lowest point, from the top of its flight. Falls below 5 cm are left
///         out: a thing that settles or bounces.
class FallEvents {
 public:
  /// Keeps a reference.
  explicit FallEvents(const Scenario& scenario);

  void Observe(const Instant& before, const Instant& after);
  std::vector<RecordedEvent> All() const { return drops_.All(); }

 private:
  const Scenario& scenario_;
  HeldEvents drops_;
  std::vector<double> top_m_;  ///< of each obstacle's flight
};

}  // namespace tera
