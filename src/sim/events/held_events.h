#pragma once

#include <map>
#include <string>
#include <vector>

#include "dataset/format/events_table.h"

namespace tera {

/// The machine, its part and the other body of an event, as in RecordedEvent.
struct EventSubject {
  std::string machine, part, other;

  auto operator<=>(const EventSubject&) const = default;
};

/// Events of one kind that last as long as a condition holds.
///
/// Model   hysteresis in time: an event begins with its condition, goes on over pauses of at most
///         `pause_ns`, and ends when the condition last held. Stretches without a pause that are
///         shorter than `least_ns` do not count, nor do events below `least_value`.
class HeldEvents {
 public:
  struct Rule {
    EventKind kind;
    TimeNs pause_ns = 0;
    bool keeps_least = false;  ///< the value is the least of all; otherwise the largest
    TimeNs least_ns = 0;       ///< duration of the shortest stretch without a pause
    double least_value = 0;
  };
  explicit HeldEvents(const Rule& rule) : rule_(rule) {}

  /// The condition of `subject` holds from `begin_ns` to `end_ns`, adjacent to its last call or
  /// not. Returns true if an event begins.
  bool Hold(const EventSubject& subject, TimeNs begin_ns, TimeNs end_ns, double value);
  /// Call after each step: ends stretches that do not reach `now_ns`, and events whose condition
  /// has not held for longer than a pause.
  void Close(TimeNs now_ns);

  /// Ended events, and those that go on, as far as they have come.
  std::vector<RecordedEvent> All() const;

 private:
  bool Counts(const RecordedEvent& event) const { return event.value >= rule_.least_value; }
  void Extend(RecordedEvent* event, TimeNs end_ns, double value) const;

  Rule rule_;
  std::map<EventSubject, RecordedEvent> stretches_;  ///< without a pause up to now
  std::map<EventSubject, RecordedEvent> going_on_;
  std::vector<RecordedEvent> ended_;
};

}  // namespace tera
