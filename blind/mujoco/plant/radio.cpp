#include "blind/mujoco/plant/radio.h"

#include <cmath>
#include <numbers>

namespace tera::blind::mujoco {

Radio::Radio(double doppler_hz, const Stream& paths, std::uint32_t lane) {
  constexpr double kTau = 2 * std::numbers::pi;
  for (std::size_t n = 0; n < kPaths; ++n) {
    const double from_rad = kTau * (static_cast<double>(n) + paths.Uniform(n, lane)) / kPaths;
    shift_radps_[n] = kTau * doppler_hz * std::cos(from_rad);
    phase_rad_[n] = kTau * paths.Uniform(n, lane + 1);
  }
}

double Radio::PowerAt(double t_s) const {
  double in_phase = 0, quadrature = 0;
  for (std::size_t n = 0; n < kPaths; ++n) {
    const double phase_rad = shift_radps_[n] * t_s + phase_rad_[n];
    in_phase += std::cos(phase_rad);
    quadrature += std::sin(phase_rad);
  }
  return (in_phase * in_phase + quadrature * quadrature) / kPaths;
}

bool Radio::Loses(double t_s, double lost) const { return PowerAt(t_s) < -std::log(1 - lost); }

}  // namespace tera::blind::mujoco
