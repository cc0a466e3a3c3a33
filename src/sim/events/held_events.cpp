#include "sim/events/held_events.h"

#include <algorithm>

namespace tera {

bool HeldEvents::Hold(const EventSubject& subject, TimeNs begin_ns, TimeNs end_ns, double value) {
  RecordedEvent& stretch =
      stretches_
          .try_emplace(subject, RecordedEvent{begin_ns, end_ns, rule_.kind, subject.machine,
                                              subject.part, subject.other, value})
          .first->second;
  Extend(&stretch, end_ns, value);
  if (stretch.end_ns - stretch.begin_ns < rule_.least_ns) return false;
  const auto [event, is_new] = going_on_.try_emplace(subject, stretch);
  Extend(&event->second, end_ns, stretch.value);
  return is_new;
}

void HeldEvents::Extend(RecordedEvent* event, TimeNs end_ns, double value) const {
  event->end_ns = end_ns;
  event->value = rule_.keeps_least ? std::min(event->value, value) : std::max(event->value, value);
}

void HeldEvents::Close(TimeNs now_ns) {
  std::erase_if(stretches_, [&](const auto& stretch) { return stretch.second.end_ns < now_ns; });
  for (auto it = going_on_.begin(); it != going_on_.end();) {
    // A stretch that is still too short may yet end the pause.
    const auto stretch = stretches_.find(it->first);
    const TimeNs paused_to_ns = stretch == stretches_.end() ? now_ns : stretch->second.begin_ns;
    if (paused_to_ns - it->second.end_ns <= rule_.pause_ns) {
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
