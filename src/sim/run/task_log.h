#pragma once

#include <filesystem>
#include <optional>

#include "dataset/format/measurement_sink.h"
#include "sim/scenario/scenario.h"

namespace tera {

/// File of a recording with the map of the deviation at its end.
inline constexpr char kDeviationMap[] = "truth/terrain/deviation_end.tif";

/// The channel of a task's progress.
ChannelInfo TaskChannel();

/// Writes the progress of a scenario's task, and says when it is done.
///
/// Model   a row at the start and after each tenth of a second. The task is done when 95 % of the
///         floor has stayed within the tolerance for five seconds.
class TaskLog {
 public:
  /// Keeps a reference to the ground. Nothing happens without a task.
  TaskLog(const Scenario& scenario, const TerrainSurface& ground, MeasurementSink* sink);

  /// Call after each step; `t_ns` is its end.
  void Write(TimeNs t_ns);
  bool IsDone() const { return done_; }
  /// Deviation of the last row; nothing without a task.
  const std::optional<TaskDeviation>& deviation() const { return deviation_; }
  /// The ground minus the design, as GeoTIFF like the other rasters of the ground.
  void WriteMap(const std::filesystem::path& file) const;
  bool HasTask() const { return columns_.has_value(); }

 private:
  const Scenario& scenario_;
  const TerrainSurface& ground_;
  MeasurementSink* sink_;
  std::optional<TaskColumns> columns_;
  ChannelId channel_{};
  std::int64_t next_ = 1;  ///< next multiple of the period
  std::optional<TimeNs> within_since_ns_;
  bool done_ = false;
  std::optional<TaskDeviation> deviation_;
};

}  // namespace tera
