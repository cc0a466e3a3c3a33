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
  double rate_hz = 100;         ///< of /clock, of the states, and of looking for levers
  double answer_timeout_s = 5;  ///< in lock-step
  /// The run ends with the step of the physics that reaches it.
  double duration_s = std::numeric_limits<double>::infinity();
  LiveOptions live;
  std::function<void()> started;                ///< called where nothing hinders the run
  std::function<bool()> stop;                   ///< asked before each tick
  std::function<void(const std::string&)> log;  ///< what a user should know meanwhile
  Wall wall;                                    ///< that Pace::kReal keeps to
};

struct LiveRosReport {
  double simulated_s = 0, wall_s = 0;
  std::int64_t published = 0, dropped = 0;
  std::int64_t levers_received = 0, levers_refused = 0;
  std::int64_t levers_unasked = 0;  ///< in lock-step: of another time, or not the first
  std::int64_t timeouts = 0;        ///< answers that did not come in lock-step
};

/// Runs a scenario for ROS 2 until its duration or `stop`. Throws InputError where names are none
/// of ROS's, the rate is beyond that of the physics, or DDS cannot start.
LiveRosReport RunForRos(std::shared_ptr<const Scenario> scenario, const std::string& resolved_yaml,
                        const LiveRosOptions& options);

}  // namespace tera::ros
