#pragma once

#include <cstdint>
#include <string>

#include "core/types/effects.h"
#include "core/types/measurement.h"
#include "sensors/imu/imu_errors.h"
#include "sensors/slots/low_pass.h"
#include "sensors/slots/report_clock.h"

namespace tera {

/// Signs of the axes of an inertial unit whose readings come with the wrong ones, `axis_flip`.
Vec3 AxisSigns(const Effects& effects);

/// What lies between the measurement of an inertial unit's own model and the one it reports
/// (src/sensors/README.md).
class ImuSlots {
 public:
  ImuSlots(const Effects& effects, std::uint64_t seed, const std::string& stream_name);
  void Apply(ImuSample* sample);

 private:
  bool ideal_;
  Vec3 axis_signs_;
  ImuErrors errors_;
  LowPass filter_;
  ReportClock clock_;
  std::int64_t next_ = 0;
};

}  // namespace tera
