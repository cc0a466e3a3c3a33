#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/time.h"
#include "dataset/format/measurement_sink.h"
#include "sim/scenario/scenario.h"
#include "sim/world_state.h"

namespace tera {

/// Writes the pose of each link, each sensor and each moving obstacle at the scenario's rate
/// (`record: {poses_hz}`). Without a rate it writes dynamic obstacles alone, 50 times a second.
///
/// Frames  X_WB of links and obstacles; X_WS of sensors, S as in sensor.yaml. A sensor whose
///         effects move it has two files: its true pose, and the pose of its sensor.yaml.
/// Model   interpolation between two steps as for sensors: positions linear, rotations along the
///         shortest arc. The first row is at the start.
class PoseLog {
 public:
  PoseLog(const Scenario& scenario, MeasurementSink* sink);

  void WriteStart(const Instant& now) { Write(now, now); }
  void Write(const Instant& before, const Instant& after);

 private:
  /// A pose at a constant offset from a body of an Instant.
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
