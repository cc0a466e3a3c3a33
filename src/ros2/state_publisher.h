#pragma once

#include <optional>
#include <vector>

#include "ros2/from_machine.h"
#include "ros2/participant.h"
#include "sim/simulation.h"

namespace tera::ros {

/// Publishes time and true machine states: /clock, /tf and /tf_static. For each machine it
/// publishes odom and joint_states; cylinders if the machine has any; and ee_pose and bucket_mass
/// if it has a shovel that can carry soil.
class StatePublisher {
 public:
  /// Publishes /tf_static at once. Keeps references to all arguments except `start`.
  StatePublisher(const Scenario& scenario, const WorldState& start, Participant* participant);

  /// Publishes the state at one instant. /clock comes last, so that its receivers already have the
  /// other messages.
  void Publish(const WorldState& state);
  /// Publishes the last /clock message again.
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
