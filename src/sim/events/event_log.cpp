#include "sim/events/event_log.h"

namespace tera {

EventLog::EventLog(const Scenario& scenario, const Instant& start)
    : contacts_(scenario), spills_(scenario), tips_(scenario), falls_(scenario), people_(scenario) {
  contacts_.Observe(start, start);
  tips_.Observe(start);
  people_.Observe(start);
}

void EventLog::Observe(const WorldStep& step) {
  contacts_.Observe(step.before, step.after);
  spills_.Observe(step.before, step.after, step.ground);
  tips_.Observe(step.after);
  falls_.Observe(step.before, step.after);
  people_.Observe(step.after);
}

std::vector<RecordedEvent> EventLog::All() const {
  std::vector<RecordedEvent> all;
  const auto add = [&](const std::vector<RecordedEvent>& events) {
    all.insert(all.end(), events.begin(), events.end());
  };
  add(contacts_.All());
  add(spills_.All());
  add(tips_.All());
  add(falls_.All());
  add(people_.All());
  return all;
}

}  // namespace tera
