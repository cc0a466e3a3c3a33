#pragma once

#include <complex>

#include "physics/machine.h"

namespace tera {

/// Rate that a hydraulic joint is driven to, after the history of its command.
///
/// Model   A step of the commanded rate by w_ss answers with w(t) = w_ss (1 + sin(eta t + phi)
///         e^(-beta t)), t > 0; several steps superpose, so that the response is that of a linear
///         filter and a lever moved back ends at rest. With phi = 0 the law asks for w_ss at
///         t = 0+ already; how fast the joint really starts from rest is then set by its effort
///         limit and its load. Without a transient the commanded rate itself.
/// Omits   dead band, flow sharing between joints, load dependence.
/// Source  TERA paper, eq. (1).
class RateResponse {
 public:
  explicit RateResponse(const RateTransient& transient);

  /// Rate at the end of a step of `dt_s` during which `command_radps` is asked for.
  double Advance(double command_radps, double dt_s);

 private:
  RateTransient transient_;
  double command_radps_ = 0;
  /// Sum over all steps of w_ss e^(i phi) e^((-beta + i eta) t); its imaginary part is the ringing.
  std::complex<double> ringing_radps_ = 0;
};

}  // namespace tera
