#pragma once

#include <optional>
#include <vector>

#include "dataset/format/measurement_sink.h"
#include "sim/simulation.h"

namespace tera {

/// The truth channels of a scenario, in order: commands, pose, joints and cylinders of each
/// machine, then the bed of each obstacle, then the progress of the task.
std::vector<ChannelInfo> TruthChannels(const Scenario& scenario);

/// Writes the truth: commands of every machine, poses, joints, loads and cylinders, and the loads
/// of obstacles' beds.
///
/// Model   one row for each step. The physics step gives the rates that carry the pose from one row
///         to the next, valid midway between them. A row holds the mean of the rates before and
///         after it, which is second order at its own time.
class TruthLog {
 public:
  TruthLog(const Scenario& scenario, MeasurementSink* sink);

  /// The state `before` a step, the state `after` it, and the levers in force in between.
  void Write(const Instant& before, const Instant& after);

 private:
  struct Channels {
    ChannelId commands, pose, joints;
    std::optional<ChannelId> hydraulics;
  };
  void WriteRow(ChannelId channel, TimeNs t_ns, const std::vector<double>& values);
  void WriteStates(const Instant& now, const Instant& next);

  MeasurementSink* sink_;
  std::size_t soils_;  ///< number of the site's soils
  std::vector<Channels> channels_;
  std::vector<std::optional<ChannelId>> beds_;  ///< one per obstacle
};

}  // namespace tera
