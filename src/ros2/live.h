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
  double rate_hz = 100;         ///< rate of /clock, of the states, and of lever input
  double answer_timeout_s = 5;  ///< in lockstep
  /// The run ends with the physics step that reaches this duration.
  double duration_s = std::numeric_limits<double>::infinity();
  LiveOptions live;
  std::function<void()> started;                ///< called when the run is ready to start
  std::function<bool()> stop;                   ///< queried before each tick
  std::function<void(const std::string&)> log;  ///< receives messages for the user
  Wall wall;                                    ///< clock of Pace::kReal
};

struct LiveRosReport {
  double simulated_s = 0, wall_s = 0;
  std::int64_t published = 0, dropped = 0;
  std::int64_t levers_received = 0, levers_refused = 0;
  std::int64_t levers_unasked = 0;  ///< in lockstep: another stamp, or a repeated answer
  std::int64_t timeouts = 0;        ///< missing answers in lockstep
};

/// Runs a scenario for ROS 2 until its duration or `stop`. Throws InputError for invalid ROS names,
/// for a rate above the physics rate, and if DDS cannot start.
LiveRosReport RunForRos(std::shared_ptr<const Scenario> scenario, const std::string& resolved_yaml,
                        const LiveRosOptions& options);

}  // namespace tera::ros
