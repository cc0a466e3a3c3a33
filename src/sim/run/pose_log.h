#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/time.h"
#include "dataset/format/measurement_sink.h"
#include "sim/scenario/scenario.h"
#include "sim/world_state.h"

namespace tera {

/// Writes the poses of links, sensors and moving obstacles at the scenario's rate (`record:
/// {poses_hz}`). Without a rate it writes dynamic obstacles only, 50 times per second.
///
/// Frames  X_WB of links and obstacles; X_WS of sensors, with S as in sensor.yaml. A sensor that
///         its effects displace has two files: its true pose, and the pose by its sensor.yaml.
/// Model   positions are interpolated linearly between two steps, rotations along the shortest arc.
///         Sensors use the same interpolation. The first row is at the start.
class PoseLog {
 public:
  PoseLog(const Scenario& scenario, MeasurementSink* sink);

  void WriteStart(const Instant& now) { Write(now, now); }
  void Write(const Instant& before, const Instant& after);

 private:
  /// A pose with a constant offset from a body.
  struct Followed {
    ChannelId channel;
    std::function<const Pose&(const Instant&)> X_WB;
    Pose X_BS = Pose::Identity();
  };

  void FollowMachine(const ScenarioMachine& machine, std::size_t m);
  void Follow(const std::string& file, std::function<const Pose&(const Instant&)> X_WB,
              const Pose& X_BS);

  MeasurementSink* sink_;
  SampleClock clock_;
  std::int64_t next_ = 0;
  std::vector<Followed> followed_;
};

}  // namespace tera
