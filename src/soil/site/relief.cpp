#include "soil/site/relief.h"

#include <cmath>
#include <string>

#include "core/random.h"
#include "core/units.h"

namespace tera {
namespace {

constexpr int kOctaves = 3;
constexpr double kGradientNoisePeak = 0.7;  ///< greatest value of gradient noise, about sqrt(1/2)

double Blend(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }

/// Gradient noise at lattice coordinates (x, y).
double Noise(const Stream& stream, double x, double y) {
  const double xf = std::floor(x), yf = std::floor(y);
  const auto corner = [&](int a, int b) {
    const auto i = static_cast<std::uint32_t>(static_cast<std::int32_t>(xf) + a);
    const auto j = static_cast<std::uint32_t>(static_cast<std::int32_t>(yf) + b);
    const double angle_rad = 2 * kPi * stream.Uniform((static_cast<std::uint64_t>(j) << 32) | i);
    return std::cos(angle_rad) * (x - xf - a) + std::sin(angle_rad) * (y - yf - b);
  };
  const double u = Blend(x - xf), v = Blend(y - yf);
  return (1 - v) * ((1 - u) * corner(0, 0) + u * corner(1, 0)) +
         v * ((1 - u) * corner(0, 1) + u * corner(1, 1));
}

}  // namespace

double Relief::HeightAt(double x_m, double y_m) const {
  double z_m = std::tan(slope_rad) *
               (x_m * std::cos(slope_direction_rad) + y_m * std::sin(slope_direction_rad));
  if (amplitude_m <= 0) return z_m;
  double share = 1, total = 0, sum = 0;
  for (int octave = 0; octave < kOctaves; ++octave) {
    const Stream stream(seed, "terrain/relief/" + std::to_string(octave));
    sum += share * Noise(stream, x_m / (wavelength_m * share), y_m / (wavelength_m * share));
    total += share;
    share /= 2;
  }
  return z_m + amplitude_m * sum / (total * kGradientNoisePeak);
}

}  // namespace tera
