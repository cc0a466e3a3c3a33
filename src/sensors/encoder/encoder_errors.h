#pragma once

#include <string>
#include <vector>

#include "core/types/effects.h"
#include "core/types/measurement.h"
#include "sensors/slots/static_errors.h"

namespace tera {

/// Errors `axis_flip` and `sensor_static` of one axis, for angles in rad or travel in m.
///
/// Model   Position: s m q + b + c dT(t) + o, clipped to +-limit, rounded to a multiple of the
///         step. Rate: s m_r qd + b_r, clipped and rounded. s = -1 with `axis_flip`; m and m_r come
///         from `scale`; b and b_r from `bias`; c dT(t) from `temperature_drift`; o from
///         `outliers`. `saturation` clips, `quantisation` rounds. Prismatic axes use the parameters
///         in metres, other axes those in degrees.
/// Omits   Eccentricity; effect of an angle's bias on the rate.
class AxisErrors {
 public:
  AxisErrors(const Effects& effects, bool linear, std::uint64_t seed,
             const std::string& stream_name);
  /// Errors of the sensing element: sign, scale, bias, drift.
  void Sense(TimeNs t_ns, double* position, double* rate) const;
  /// Errors of the read-out, downstream of a filter: outliers, saturation, quantisation.
  void ReadOut(std::int64_t k, double* position, double* rate) const;

 private:
  double sign_, position_factor_, rate_factor_, position_bias_, rate_bias_, drift_per_k_, outlier_,
      position_limit_, rate_limit_, position_step_, rate_step_;
  WarmUp warm_up_;
  OutlierDraw outliers_;
};

/// Effects of one axis: its own effects, and those of the sensor that it does not override.
Effects EffectsOfAxis(const Effects& sensor, const Effects& axis);

}  // namespace tera
