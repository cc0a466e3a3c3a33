#include "resimulate/sensor_calibration.h"

#include "sensors/slots/range_errors.h"
#include "sensors/slots/report_clock.h"
#include "sensors/slots/true_mount.h"

namespace tera {

SensorCalibration CalibrationUnder(const Pose& X_BS, const Effects& effects) {
  const RangeScaling ranges = RangeScalingOf(effects);
  return {TrueMount(X_BS, effects), ranges.factor, ranges.bias_m, ClockOffset_s(effects)};
}

}  // namespace tera
