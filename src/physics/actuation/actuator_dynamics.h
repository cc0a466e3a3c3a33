#pragma once

#include <cmath>
#include <complex>
#include <limits>

#include "core/types/effects.h"

namespace tera {

/// Response of an actuator's rate to its command. The defaults have no delay.
struct ActuatorParameters {
  double max_change_radps2 = std::numeric_limits<double>::infinity();
  double band_s = 0;  ///< time constant of the error within the rate limit
  double lag_s = 0, pilot_s = 0;
  bool rings = false;
  double eta_radps = 0, beta_1ps = 0, phi_rad = 0;
  double cushion_rad = 0, cushion_ratio = 1;
  double lower_rad = 0, upper_rad = 0;  ///< end stops, for the cushion
  double max_rate_positive_radps = 0, max_rate_negative_radps = 0;
};

/// All parameters except the limits of travel and rate, which belong to the joint.
ActuatorParameters ActuatorOf(const Effects& effects);

/// Slot `actuator` of one joint or gear.
///
/// Model   The mechanisms act in this order. All are exact for a command that is constant over each
///         step.
///         - rate_limit: dw/dt = (u - w) / band, limited in either direction.
///         - actuator_lag: Tp dx/dt = u - x, T dw/dt = x - w, for the pilot stage and the main
///           stage.
///         - actuator_ring: the linear filter with the step response w(t) = w_ss (1 + sin(eta t +
///           phi) e^(-beta t)), t > 0. Responses to several steps add, so that a lever moved back
///           ends at rest.
///         - end_cushion: within the distance z of a stop, the rate towards it is at most the full
///           rate times (r + (1 - r) distance / z).
/// Omits   Dependence on pressure and temperature.
/// Source  TERA paper, eq. (1): actuator_ring. With phi = 0 it demands w_ss already at t = 0+; the
///         effort limit and the load of the joint then determine the real start from rest.
class ActuatorDynamics {
 public:
  explicit ActuatorDynamics(const ActuatorParameters& parameters)
      : parameters_(parameters),
        acts_(std::isfinite(parameters.max_change_radps2) || parameters.lag_s > 0 ||
              parameters.rings || parameters.cushion_rad > 0) {}

  /// Rate at the end of a step of `dt_s` with a constant command, for a joint at `position_rad`.
  double Step(double command_radps, double position_rad, double dt_s) {
    return acts_ ? Act(command_radps, position_rad, dt_s) : command_radps;
  }

 private:
  double Act(double command_radps, double position_rad, double dt_s);
  void Prepare(double dt_s);
  double Limit(double command_radps, double dt_s) const;
  double Lag(double command_radps);
  double Ring(double command_radps);
  double Cushion(double rate_radps, double position_rad) const;

  ActuatorParameters parameters_;
  bool acts_;
  double limited_radps_ = 0, piloted_radps_ = 0, lagged_radps_ = 0, ring_command_radps_ = 0;
  /// Sum over all command steps of w_ss e^(i phi) e^((-beta + i eta) t). Its imaginary part is the
  /// oscillation.
  std::complex<double> ringing_radps_ = 0;
  double dt_s_ = 0;                         ///< step length of the following values
  double lag_keeps_ = 0, pilot_keeps_ = 0;  ///< share of an error that remains after a step
  /// Share of the pilot's error that enters the lag's error in a step.
  double lag_of_pilot_ = 0;
  std::complex<double> phase_ = 1, turn_ = 1;
};

}  // namespace tera
