#pragma once

#include <atomic>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "ros2/cdr.h"
#include "ros2/fast_peer.h"
#include "ros2/live.h"
#include "ros2/peer_process.h"

// Whole runs of two machines, observed and driven by another DDS implementation on the loopback
// interface. No test asserts a duration; timeouts are far longer than needed.

namespace tera {

/// Two excavators, red with every kind of sensor, blue with an IMU.
extern const char* const kTwoMachines;

/// A run in its own thread, stopped and joined at the latest by the destructor.
class BackgroundRun {
 public:
  explicit BackgroundRun(ros::LiveRosOptions options);
  ~BackgroundRun() { End(); }

  ros::LiveRosReport End();
  ros::LiveRosReport Wait();
  std::vector<std::string> log();

 private:
  void Run();

  ros::LiveRosOptions options_;
  ros::LiveRosReport report_;
  std::atomic<bool> stop_ = false;
  std::mutex mutex_;
  std::vector<std::string> log_;
  std::thread thread_;
};

extern const FastPeer::Wish kClock;
FastPeer::Wish JointStatesOf(const std::string& machine);
FastPeer::Wish LeversOf(const std::string& machine);

TimeNs ClockOf(const Payload& payload);

struct JointView {
  TimeNs t_ns = 0;
  std::map<std::string, double> position, velocity, effort;
};
JointView JointsOf(const Payload& payload);

/// The payload, or an empty one after a failure.
Payload Require(const std::optional<Payload>& payload, const std::string& what);

/// A reply to /clock at `t_ns`.
LeverMessage AnswerTo(TimeNs t_ns);

}  // namespace tera
