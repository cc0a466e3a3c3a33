#pragma once

#include <optional>
#include <vector>

#include "dataset/format/measurement_sink.h"
#include "sim/simulation.h"

namespace tera {

/// The truth channels of a scenario, in order: for each machine commands, pose, joints and
/// cylinders; then the bed of each obstacle; then the progress of the task.
std::vector<ChannelInfo> TruthChannels(const Scenario& scenario);

/// Writes the truth: commands, poses, joints, loads and cylinders of machines, and the loads of
/// obstacles' beds.
///
/// Model   one row for each step. A physics step yields the rates that lead from one pose to the
///         next, which are those at mid-step. A row contains the mean of the rates before and after
///         it. This is second-order accurate at the time of the row.
class TruthLog {
 public:
  TruthLog(const Scenario& scenario, MeasurementSink* sink);

  /// State before and after a step, with the levers that acted in between.
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
