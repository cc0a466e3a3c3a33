#pragma once

#include <string>
#include <vector>

#include "core/types/effects.h"
#include "core/types/measurement.h"
#include "sensors/slots/static_errors.h"

namespace tera {

/// Sign and slot `sensor_static` of an axis, for angles in rad or travel in m.
///
/// Model   position: s m q + b + c dT(t) + o, clipped to +-limit, rounded to a multiple of the
///         step; rate: s m_r qd + b_r, clipped, rounded. s = -1: `axis_flip`; m, m_r: `scale`; b,
///         b_r: `bias`; c dT(t): `temperature_drift`; o: `outliers`; then `saturation`,
///         `quantisation`. Prismatic axes use the parameters in metres, others the parameters in
///         degrees.
/// Omits   eccentricity; effect of an angle's bias on the rate.
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

/// Effects of one axis: its own, and the sensor's effects that it does not override.
Effects EffectsOfAxis(const Effects& sensor, const Effects& axis);

}  // namespace tera
