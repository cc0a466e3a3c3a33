#pragma once

#include <filesystem>
#include <optional>

#include "dataset/format/measurement_sink.h"
#include "sim/scenario/scenario.h"

namespace tera {

/// File in a recording that contains the map of the final deviation from the design.
inline constexpr char kDeviationMap[] = "truth/terrain/deviation_end.tif";

/// The channel with the progress of a task.
ChannelInfo TaskChannel();

/// Writes the progress of a scenario's task, and detects its completion.
///
/// Model   one row at the start and one every tenth of a second. The task is done when 95 % of the
///         floor has been within the tolerance for five seconds.
class TaskLog {
 public:
  /// Keeps a reference to `ground`. Has no effect without a task.
  TaskLog(const Scenario& scenario, const TerrainSurface& ground, MeasurementSink* sink);

  /// Must be called after each step; `t_ns` is its end.
  void Write(TimeNs t_ns);
  bool IsDone() const { return done_; }
  /// Deviation in the last row. Empty without a task.
  const std::optional<TaskDeviation>& deviation() const { return deviation_; }
  /// Writes ground minus design as GeoTIFF, like the other rasters of the ground.
  void WriteMap(const std::filesystem::path& file) const;
  bool HasTask() const { return columns_.has_value(); }

 private:
  const Scenario& scenario_;
  const TerrainSurface& ground_;
  MeasurementSink* sink_;
  std::optional<TaskColumns> columns_;
  ChannelId channel_{};
  std::int64_t next_ = 1;  ///< index of the next row, in periods
  std::optional<TimeNs> within_since_ns_;
  bool done_ = false;
  std::optional<TaskDeviation> deviation_;
};

}  // namespace tera
