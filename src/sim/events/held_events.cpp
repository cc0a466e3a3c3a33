#include "sim/events/held_events.h"

#include <algorithm>

namespace tera {

bool HeldEvents::Hold(const EventSubject& subject, TimeNs begin_ns, TimeNs end_ns, double value) {
  const auto [found, is_new] = going_on_.try_emplace(subject);
  RecordedEvent& event = found->second;
  if (is_new) {
    event = {begin_ns, end_ns, rule_.kind, subject.machine, subject.part, subject.other, value};
    return true;
  }
  event.end_ns = end_ns;
  event.value = rule_.keeps_least ? std::min(event.value, value) : std::max(event.value, value);
  return false;
}

void HeldEvents::Close(TimeNs now_ns) {
  for (auto it = going_on_.begin(); it != going_on_.end();) {
    if (now_ns - it->second.end_ns <= rule_.pause_ns) {
      ++it;
      continue;
    }
    if (Counts(it->second)) ended_.push_back(it->second);
    it = going_on_.erase(it);
  }
}

std::vector<RecordedEvent> HeldEvents::All() const {
  std::vector<RecordedEvent> all = ended_;
  for (const auto& [subject, event] : going_on_) {
    if (Counts(event)) all.push_back(event);
  }
  return all;
}

}  // namespace tera
