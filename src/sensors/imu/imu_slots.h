#pragma once

#include <cstdint>
#include <string>

#include "core/types/effects.h"
#include "core/types/measurement.h"
#include "sensors/imu/imu_errors.h"
#include "sensors/slots/low_pass.h"
#include "sensors/slots/report_clock.h"

namespace tera {

/// Signs of the axes of an inertial unit with reversed readings, `axis_flip`.
Vec3 AxisSigns(const Effects& effects);

/// Errors between an inertial unit's model and its reported measurement (src/sensors/README.md).
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
