#pragma once

#include <optional>
#include <vector>

#include "ros2/from_machine.h"
#include "ros2/participant.h"
#include "sim/simulation.h"

namespace tera::ros {

/// Publishes time and true machine states: /clock, /tf, /tf_static. Below each machine it publishes
/// odom, joint_states, cylinders if present, and ee_pose and bucket_mass for a shovel that carries
/// soil.
class StatePublisher {
 public:
  /// Sends /tf_static at once. Keeps references to all arguments except `start`.
  StatePublisher(const Scenario& scenario, const WorldState& start, Participant* participant);

  /// Publishes one instant, /clock last, so that its receivers already have the other messages.
  void Publish(const WorldState& state);
  /// Repeats /clock alone.
  void RepeatClock();

 private:
  struct Topics {
    Participant::WriterId odom, joint_states, cylinders = -1;
    std::optional<EndEffector> tool;
    Participant::WriterId ee_pose = -1, bucket_mass = -1;
  };

  const Scenario& scenario_;
  Participant* participant_;
  Participant::WriterId clock_, tf_;
  std::vector<Topics> topics_;  ///< one per machine
  TimeNs now_ns_ = 0;
};

}  // namespace tera::ros
