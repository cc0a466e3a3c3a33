#pragma once

#include <cstdint>
#include <string>

#include "core/types/effects.h"
#include "core/types/measurement.h"
#include "sensors/slots/range_errors.h"
#include "sensors/slots/report_clock.h"

namespace tera {

/// What lies between the measurement of a lidar's or a camera's own model and the one it reports
/// (src/sensors/README.md). Its measurements can be left out when their files are there already.
class FrameSlots {
 public:
  FrameSlots(const Effects& effects, std::uint64_t seed, const std::string& stream_name);
  /// The times that measurement `k`, valid at `t_ns`, gets; once for each, in order.
  ReportClock::Times Stamp(std::int64_t k, TimeNs t_ns);
  void Apply(std::int64_t k, const ReportClock::Times& times, LidarScan* scan) const;
  void Apply(std::int64_t k, const ReportClock::Times& times, CameraFrame* frame) const;

 private:
  RangeErrors errors_;
  ReportClock clock_;
};

}  // namespace tera
