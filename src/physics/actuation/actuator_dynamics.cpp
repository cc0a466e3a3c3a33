#include "physics/actuation/actuator_dynamics.h"

#include <algorithm>
#include <cmath>

namespace tera {
namespace {

/// (e^x - 1) / x.
double ExpM1Over(double x) { return x == 0 ? 1 : std::expm1(x) / x; }

}  // namespace

ActuatorParameters ActuatorOf(const Effects& effects) {
  ActuatorParameters parameters;
  if (const Effect* limit = FindEffect(effects, "rate_limit")) {
    parameters.max_change_radps2 = (*limit)["max_change_radps2"];
    parameters.band_s = (*limit)["band_s"];
  }
  if (const Effect* lag = FindEffect(effects, "actuator_lag")) {
    parameters.lag_s = (*lag)["time_s"];
    parameters.pilot_s = parameters.lag_s * (*lag)["pilot_ratio"];
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
    rate = limited_radps_ = Limit(rate, dt_s);
  }
  if (parameters_.lag_s > 0) rate = Lag(rate);
  if (parameters_.rings) rate = Ring(rate);
  if (parameters_.cushion_rad > 0) rate = Cushion(rate, position_rad);
  return rate;
}

void ActuatorDynamics::Prepare(double dt_s) {
  dt_s_ = dt_s;
  const double T_s = parameters_.lag_s, Tp_s = parameters_.pilot_s;
  lag_keeps_ = T_s > 0 ? std::exp(-dt_s / T_s) : 0.0;
  pilot_keeps_ = Tp_s > 0 ? std::exp(-dt_s / Tp_s) : 0.0;
  lag_of_pilot_ = Tp_s > 0 ? dt_s / T_s * lag_keeps_ * ExpM1Over(dt_s / T_s - dt_s / Tp_s) : 0.0;
  phase_ = std::polar(1.0, parameters_.phi_rad);
  turn_ = std::polar(std::exp(-parameters_.beta_1ps * dt_s), parameters_.eta_radps * dt_s);
}

/// Moves towards the command: first at the rate limit, then with an exponentially decaying error.
double ActuatorDynamics::Limit(double command_radps, double dt_s) const {
  const double error = command_radps - limited_radps_;
  const double most = parameters_.max_change_radps2, band_s = parameters_.band_s;
  const double beyond_s = std::abs(error) / most - band_s;
  if (beyond_s >= dt_s) return limited_radps_ + std::copysign(most * dt_s, error);
  if (band_s == 0) return command_radps;
  const double decays_s = dt_s - std::max(0.0, beyond_s);
  const double from = beyond_s > 0 ? std::copysign(most * band_s, error) : error;
  return command_radps - from * std::exp(-decays_s / band_s);
}

double ActuatorDynamics::Lag(double command_radps) {
  const double pilot_is_short = command_radps - piloted_radps_;
  const double lag_is_short = command_radps - lagged_radps_;
  piloted_radps_ = command_radps - pilot_keeps_ * pilot_is_short;
  lagged_radps_ = command_radps - lag_keeps_ * lag_is_short - lag_of_pilot_ * pilot_is_short;
  return lagged_radps_;
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
