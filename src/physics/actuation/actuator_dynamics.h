#pragma once

#include <cmath>
#include <complex>
#include <limits>

#include "core/types/effects.h"

namespace tera {

/// How an actuator's rate follows its command. The defaults follow at once.
struct ActuatorParameters {
  double max_change_radps2 = std::numeric_limits<double>::infinity();
  double band_s = 0;  ///< time constant with which an error within the rate limit closes
  double lag_s = 0, pilot_s = 0;
  bool rings = false;
  double eta_radps = 0, beta_1ps = 0, phi_rad = 0;
  double cushion_rad = 0, cushion_ratio = 1;
  double lower_rad = 0, upper_rad = 0;  ///< end stops, for the cushion
  double max_rate_positive_radps = 0, max_rate_negative_radps = 0;
};

/// All parameters except the limits of travel and rate, which are the joint's.
ActuatorParameters ActuatorOf(const Effects& effects);

/// Slot `actuator` of one joint or gear.
///
/// Model   In this order:
///         rate_limit: dw/dt = (u - w) / band, limited in either direction;
///         actuator_lag: Tp dx/dt = u - x, T dw/dt = x - w, for the pilot and the stage it moves;
///         actuator_ring: the linear filter with the step response w(t) = w_ss (1 + sin(eta t +
///         phi) e^(-beta t)), t > 0. Steps superpose, so that a lever moved back ends at rest;
///         end_cushion: within a distance z of a stop, the rate towards it is at most the full rate
///         times (r + (1 - r) distance / z).
///         All are exact for a command held over each step.
/// Omits   dependence on pressure and temperature.
/// Source  TERA paper, eq. (1): actuator_ring. With phi = 0 it demands w_ss already at t = 0+; the
///         joint's effort limit and load then set how fast it really starts from rest.
class ActuatorDynamics {
 public:
  explicit ActuatorDynamics(const ActuatorParameters& parameters)
      : parameters_(parameters),
        acts_(std::isfinite(parameters.max_change_radps2) || parameters.lag_s > 0 ||
              parameters.rings || parameters.cushion_rad > 0) {}

  /// Rate at the end of a step of `dt_s` with the constant command `command_radps`, for a joint at
  /// `position_rad`.
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
  /// Sum over all command steps of w_ss e^(i phi) e^((-beta + i eta) t); its imaginary part is the
  /// ringing.
  std::complex<double> ringing_radps_ = 0;
  double dt_s_ = 0;                         ///< step for which the following values hold
  double lag_keeps_ = 0, pilot_keeps_ = 0;  ///< share of an error that is left after a step
  double lag_of_pilot_ = 0;                 ///< share of the pilot's error that the lag inherits in
                                            ///< a step
  std::complex<double> phase_ = 1, turn_ = 1;
};

}  // namespace tera
