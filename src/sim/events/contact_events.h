#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "sim/events/held_events.h"
#include "sim/scenario/scenario.h"
#include "sim/world_state.h"

namespace tera {

/// Contacts of machines with obstacles, other machines and the walls of a site's mesh, and strikes
/// of their tools.
///
/// Model   contact: a part presses on another body (Bullet's contact points with an impulse). It
///         ends after 0.2 s without force. Its value is the largest normal force, a mean over a
///         physics step: the force of an impact between rigid bodies depends on the step.
///         strike: a contact of a link with a shovel begins with a closing speed of at least 0.2
///         m/s, taken before the step. Its value is the normal impulse over 20 ms from the start of
///         that step. The last step counts by its share in the 20 ms, so that the impulse does not
///         depend on the step.
/// Omits   running gear on obstacles that it climbs (the ground bears it there), contact within a
///         machine and among things, stones in the ground (soil has none).
class ContactEvents {
 public:
  /// Keeps a reference.
  explicit ContactEvents(const Scenario& scenario);

  /// Call with the states before and after each step.
  void Observe(const Instant& before, const Instant& after);

  std::vector<RecordedEvent> All() const;
  /// Names of the obstacles and machines that a machine touches, as its contacts have them.
  std::vector<std::string> Touched(std::size_t machine) const;

 private:
  /// Name of a machine or an obstacle.
  const std::string& WholeOf(const BodyContact::Side& side) const;
  EventSubject SubjectOf(const BodyContact& contact) const;
  void Observe(const BodyContact& contact, const Instant& before, const Instant& after);

  const Scenario& scenario_;
  HeldEvents contacts_;
  /// When a machine last touched another machine or an obstacle of that name.
  std::map<std::pair<std::size_t, std::string>, TimeNs> touched_ns_;
  std::map<EventSubject, RecordedEvent> strikes_;  ///< going on
  std::vector<RecordedEvent> struck_;
};

}  // namespace tera
