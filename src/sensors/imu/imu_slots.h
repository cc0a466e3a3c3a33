#pragma once

#include <cstdint>
#include <string>

#include "core/types/effects.h"
#include "core/types/measurement.h"
#include "sensors/imu/imu_errors.h"
#include "sensors/slots/low_pass.h"
#include "sensors/slots/report_clock.h"

namespace tera {

/// Signs of the axes, three rates then three forces. A sign is -1 if `axis_flip` names the axis for
/// both triads (`x`) or for its own triad (`gyro_x`). The two together cancel.
Eigen::Matrix<double, 6, 1> AxisSigns(const Effects& effects);

/// Errors between an inertial unit's model and its reported measurement (src/sensors/README.md).
class ImuSlots {
 public:
  ImuSlots(const Effects& effects, std::uint64_t seed, const std::string& stream_name);
  void Apply(ImuSample* sample);

 private:
  bool ideal_;
  Eigen::Matrix<double, 6, 1> axis_signs_;
  ImuErrors errors_;
  LowPass filter_;
  ReportClock clock_;
  std::int64_t next_ = 0;
};

}  // namespace tera
