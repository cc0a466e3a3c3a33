#pragma once

#include <cstdint>
#include <string>

#include "core/types/effects.h"
#include "core/types/measurement.h"
#include "sensors/slots/range_errors.h"
#include "sensors/slots/report_clock.h"

namespace tera {

/// Errors between a lidar's or camera's model and its reported measurement (src/sensors/README.md).
/// A caller may skip measurements whose files already exist.
class FrameSlots {
 public:
  FrameSlots(const Effects& effects, std::uint64_t seed, const std::string& stream_name);
  /// Time stamps of measurement `k`, taken at `t_ns`. Call it once per measurement, in order.
  ReportClock::Times Stamp(std::int64_t k, TimeNs t_ns);
  void Apply(std::int64_t k, const ReportClock::Times& times, LidarScan* scan) const;
  void Apply(std::int64_t k, const ReportClock::Times& times, CameraFrame* frame) const;

 private:
  RangeErrors errors_;
  ReportClock clock_;
};

}  // namespace tera
