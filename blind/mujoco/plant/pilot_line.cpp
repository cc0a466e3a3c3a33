#include "blind/mujoco/plant/pilot_line.h"

#include <cmath>

namespace tera::blind::mujoco {

double PilotLine::After(double step_s, double lever) {
  const int parts = static_cast<int>(std::ceil(8 * step_s / section_s_));  // Euler's, stable
  const double share = step_s / parts / section_s_;
  for (int part = 0; part < parts; ++part) {
    std::array<double, kSections> flow{};
    for (std::size_t k = 0; k < kSections; ++k) {
      const double before = k == 0 ? lever : pressure_[k - 1];
      const double behind = k + 1 == kSections ? pressure_[k] : pressure_[k + 1];
      flow[k] = before - 2 * pressure_[k] + behind;
    }
    for (std::size_t k = 0; k < kSections; ++k) pressure_[k] += share * flow[k];
  }
  return pressure_.back();
}

}  // namespace tera::blind::mujoco
