#pragma once

#include <functional>
#include <limits>
#include <string>

#include "ros2/pace.h"
#include "ros2/participant.h"
#include "sim/run/live_run.h"

namespace tera::ros {

struct LiveRosOptions {
  Participant::Options dds;
  Pace pace = Pace::kReal;
  double rate_hz = 100;         ///< rate of /clock, of state messages and of reading levers
  double answer_timeout_s = 5;  ///< timeout of answers in lockstep
  /// The run ends with the first physics step that reaches this time.
  double duration_s = std::numeric_limits<double>::infinity();
  LiveOptions live;
  std::function<void()> started;                ///< called once when the run is ready to start
  std::function<bool()> stop;                   ///< called before each tick; true ends the run
  std::function<void(const std::string&)> log;  ///< receives messages for the user
  Wall wall;                                    ///< clock of Pace::kReal
};

struct LiveRosReport {
  double simulated_s = 0, wall_s = 0;
  std::int64_t published = 0, dropped = 0;
  std::int64_t levers_received = 0, levers_refused = 0;
  std::int64_t levers_unasked = 0;  ///< in lockstep: messages with another stamp, and repeated
                                    ///< answers
  std::int64_t timeouts = 0;        ///< in lockstep: number of missing answers
};

/// Runs a scenario with a live ROS 2 interface, until `duration_s` or `stop`. Throws InputError for
/// names that ROS does not allow, for a rate above the physics rate, and if DDS cannot start.
LiveRosReport RunForRos(std::shared_ptr<const Scenario> scenario, const std::string& resolved_yaml,
                        const LiveRosOptions& options);

}  // namespace tera::ros
