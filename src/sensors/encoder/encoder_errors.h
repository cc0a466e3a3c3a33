#pragma once

#include <string>
#include <vector>

#include "core/types/effects.h"
#include "core/types/measurement.h"
#include "sensors/slots/static_errors.h"

namespace tera {

/// Which way an axis counts and its slot `sensor_static`, for angles in rad or travel in m.
///
/// Model   position: s m q + b + c dT(t) + o, clipped to +-limit, rounded to a multiple of the
///         step; rate: s m_r qd + b_r, clipped, rounded. s = -1: `axis_flip`; m, m_r: `scale`; b,
///         b_r: `bias`; c dT(t): `temperature_drift`; o: `outliers`; then `saturation`,
///         `quantisation`. An axis that slides takes the parameters in metres, another those in
///         degrees.
/// Omits   eccentricity; what the bias of an angle does to the rate.
class AxisErrors {
 public:
  AxisErrors(const Effects& effects, bool linear, std::uint64_t seed,
             const std::string& stream_name);
  /// What its element makes of the axis: sign, scale, bias, drift.
  void Sense(TimeNs t_ns, double* position, double* rate) const;
  /// What reading the element out adds, behind a filter: outliers, saturation, quantisation.
  void ReadOut(std::int64_t k, double* position, double* rate) const;

 private:
  double sign_, position_factor_, rate_factor_, position_bias_, rate_bias_, drift_per_k_, outlier_,
      position_limit_, rate_limit_, position_step_, rate_step_;
  WarmUp warm_up_;
  OutlierDraw outliers_;
};

/// The effects of one axis: its own, and of those of the whole sensor what it does not have itself.
Effects EffectsOfAxis(const Effects& sensor, const Effects& axis);

}  // namespace tera
