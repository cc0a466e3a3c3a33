#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/time.h"
#include "dataset/format/measurement_sink.h"
#include "sim/scenario/scenario.h"
#include "sim/world_state.h"

namespace tera {

/// Writes where everything was at the rate that the scenario states (`record: {poses_hz}`): each
/// link, each sensor and each obstacle that moves. Without a rate it writes nothing.
///
/// Frames  X_WB of links and obstacles; X_WS of sensors, S as sensor.yaml has it. A sensor that its
///         effects put elsewhere has two files: where it is, and where its sensor.yaml says.
/// Model   between two steps as sensors take it: positions linear, rotations along the shortest
///         arc. The first row is of the start.
class PoseLog {
 public:
  PoseLog(const Scenario& scenario, MeasurementSink* sink);

  void WriteStart(const Instant& now) { Write(now, now); }
  void Write(const Instant& before, const Instant& after);

 private:
  /// A pose of one instant, that of a body from which it is at a constant pose.
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
