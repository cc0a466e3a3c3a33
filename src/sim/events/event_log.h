#pragma once

#include <string>
#include <vector>

#include "sim/events/contact_events.h"
#include "sim/events/fall_events.h"
#include "sim/events/person_events.h"
#include "sim/events/spill_events.h"
#include "sim/events/tip_events.h"

namespace tera {

/// Events of a run, detected in each physics step; docs/reference/dataset.md has the table.
class EventLog {
 public:
  /// Keeps a reference to the scenario; `start` is the state at the start.
  EventLog(const Scenario& scenario, const Instant& start);

  void Observe(const WorldStep& step);

  /// Events so far; those that go on end now.
  std::vector<RecordedEvent> All() const;
  /// Names of the obstacles and machines that a machine touches.
  std::vector<std::string> Touched(std::size_t machine) const { return contacts_.Touched(machine); }

 private:
  ContactEvents contacts_;
  SpillEvents spills_;
  TipEvents tips_;
  FallEvents falls_;
  PersonEvents people_;
};

}  // namespace tera
