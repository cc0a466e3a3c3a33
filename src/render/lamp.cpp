#include "render/lamp.h"

#include <cmath>

#include "core/units.h"

namespace tera {

double PeakIntensity_cd(const Lamp& lamp) {
  constexpr int kSteps = 1000;
  double sum = 0;  // integral of the pattern over the solid angle
  for (int i = 0; i < kSteps; ++i) {
    const double share = (i + 0.5) / kSteps;
    sum += std::pow(1 - share * share, 2) * std::sin(share * lamp.half_angle_rad);
  }
  return lamp.flux_lm / (2 * kPi * sum * lamp.half_angle_rad / kSteps);
}

}  // namespace tera
