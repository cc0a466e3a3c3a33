#pragma once

#include <optional>
#include <vector>

#include "ros2/from_machine.h"
#include "ros2/participant.h"
#include "sim/simulation.h"

namespace tera::ros {

/// The time, and what every machine truly does: /clock, /tf, /tf_static, and below each machine
/// odom, joint_states, cylinders where it has any, and ee_pose and bucket_mass where it has a
/// shovel that carries.
class StatePublisher {
 public:
  /// Sends /tf_static at once. Keeps references to all but `start`.
  StatePublisher(const Scenario& scenario, const WorldState& start, Participant* participant);

  /// Everything of one moment, /clock last: who sees it has been sent the rest.
  void Publish(const WorldState& state);
  /// /clock alone, once more.
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
  std::vector<Topics> topics_;  ///< of each machine
  TimeNs now_ns_ = 0;
};

}  // namespace tera::ros
