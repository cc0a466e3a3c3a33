#pragma once

#include <optional>
#include <vector>

#include "dataset/format/measurement_sink.h"
#include "sim/simulation.h"

namespace tera {

/// The channels of what really happens in a scenario, in their order: of each machine commands,
/// pose, joints and cylinders, of each obstacle its bed.
std::vector<ChannelInfo> TruthChannels(const Scenario& scenario);

/// Writes what really happened: commands of every machine, poses, joints, loads and cylinders, and
/// what lies in the beds of obstacles.
///
/// Model   one row for each step. The physics step finds the rates that carry the pose from one
///         row to the next, so that those of the middle between two steps are known; a row holds
///         the mean of the rates before and after it, which is second order at its own time.
class TruthLog {
 public:
  TruthLog(const Scenario& scenario, MeasurementSink* sink);

  /// The state `before` a step that led to `after`, and the levers in force in between.
  void Write(const Instant& before, const Instant& after);

 private:
  struct Channels {
    ChannelId commands, pose, joints;
    std::optional<ChannelId> hydraulics;
  };
  void WriteRow(ChannelId channel, TimeNs t_ns, const std::vector<double>& values);
  void WriteStates(const Instant& now, const Instant& next);

  MeasurementSink* sink_;
  std::size_t soils_;  ///< how many soils the site has
  std::vector<Channels> channels_;
  std::vector<std::optional<ChannelId>> beds_;  ///< of each obstacle
};

}  // namespace tera
