#include "physics/rate_response.h"

namespace tera {

RateResponse::RateResponse(const RateTransient& transient) : transient_(transient) {}

double RateResponse::Advance(double command_radps, double dt_s) {
  if (!transient_.enabled) return command_radps;
  ringing_radps_ += (command_radps - command_radps_) * std::polar(1.0, transient_.phi_rad);
  command_radps_ = command_radps;
  ringing_radps_ *= std::polar(std::exp(-transient_.beta_1ps * dt_s), transient_.eta_radps * dt_s);
  return command_radps + ringing_radps_.imag();
}

}  // namespace tera
