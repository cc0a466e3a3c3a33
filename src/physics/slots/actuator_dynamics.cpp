#include "physics/slots/actuator_dynamics.h"

#include <algorithm>
#include <cmath>

namespace tera {

ActuatorParameters ActuatorOf(const Effects& effects) {
  ActuatorParameters parameters;
  if (const Effect* limit = FindEffect(effects, "rate_limit")) {
    parameters.max_change_radps2 = (*limit)["max_change_radps2"];
  }
  if (const Effect* lag = FindEffect(effects, "actuator_lag")) {
    parameters.lag_s = (*lag)["time_s"];
  }
  if (const Effect* ring = FindEffect(effects, "actuator_ring")) {
    parameters.rings = true;
    parameters.eta_radps = (*ring)["eta_radps"];
    parameters.beta_1ps = (*ring)["beta_1ps"];
    parameters.phi_rad = (*ring)["phi_rad"];
  }
  if (const Effect* cushion = FindEffect(effects, "end_cushion")) {
    parameters.cushion_rad = (*cushion)["zone_rad"];
    parameters.cushion_ratio = (*cushion)["end_ratio"];
  }
  return parameters;
}

double ActuatorDynamics::Act(double command_radps, double position_rad, double dt_s) {
  if (dt_s != dt_s_) Prepare(dt_s);
  double rate = command_radps;
  if (std::isfinite(parameters_.max_change_radps2)) {
    const double most = parameters_.max_change_radps2 * dt_s;
    limited_radps_ += std::clamp(rate - limited_radps_, -most, most);
    rate = limited_radps_;
  }
  if (parameters_.lag_s > 0) {
    lagged_radps_ += lag_step_ * (rate - lagged_radps_);
    rate = lagged_radps_;
  }
  if (parameters_.rings) rate = Ring(rate);
  if (parameters_.cushion_rad > 0) rate = Cushion(rate, position_rad);
  return rate;
}

void ActuatorDynamics::Prepare(double dt_s) {
  dt_s_ = dt_s;
  lag_step_ = parameters_.lag_s > 0 ? -std::expm1(-dt_s / parameters_.lag_s) : 1.0;
  phase_ = std::polar(1.0, parameters_.phi_rad);
  turn_ = std::polar(std::exp(-parameters_.beta_1ps * dt_s), parameters_.eta_radps * dt_s);
}

double ActuatorDynamics::Ring(double command_radps) {
  ringing_radps_ += (command_radps - ring_command_radps_) * phase_;
  ring_command_radps_ = command_radps;
  ringing_radps_ *= turn_;
  return command_radps + ringing_radps_.imag();
}

double ActuatorDynamics::Cushion(double rate_radps, double position_rad) const {
  const bool up = rate_radps > 0;
  const double distance =
      up ? parameters_.upper_rad - position_rad : position_rad - parameters_.lower_rad;
  const double inside = std::clamp(distance / parameters_.cushion_rad, 0.0, 1.0);
  if (inside >= 1) return rate_radps;
  const double full =
      up ? parameters_.max_rate_positive_radps : parameters_.max_rate_negative_radps;
  const double most = full * (parameters_.cushion_ratio + (1 - parameters_.cushion_ratio) * inside);
  return std::clamp(rate_radps, -most, most);
}

}  // namespace tera
