#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "core/random.h"
#include "physics/description/machine.h"

// Machines with a chain of links and joints of all kinds, drawn by a seed.

namespace tera {

inline Pose RandomPose(const Stream& draw, std::uint64_t index) {
  const Vec3 p = draw.Gaussian3(index, 10), rpy = draw.Gaussian3(index, 11);
  return MakePose(p, rpy[0], 0.4 * rpy[1], rpy[2]);
}

/// `kinds` of the joints, from the base on. Moving joints start away from zero.
inline MachineModel RandomMachine(std::uint64_t seed, const std::vector<JointType>& kinds) {
  const Stream draw(seed, "machine");
  MachineModel model;
  model.links.resize(kinds.size() + 1);
  model.links[0].name = "base";
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    Joint joint;
    joint.name = "joint" + std::to_string(k);
    joint.type = kinds[k];
    joint.parent = static_cast<int>(k);
    joint.child = static_cast<int>(k) + 1;
    joint.X_PJ = RandomPose(draw, k);
    joint.axis_J = draw.Gaussian3(k, 12).normalized();
    joint.initial_rad = kinds[k] == JointType::kFixed ? 0 : draw.Gaussian(k, 13);
    joint.lower_rad = -4;
    joint.upper_rad = 4;
    model.joints.push_back(joint);
    model.links[k + 1].name = "link" + std::to_string(k + 1);
  }
  return model;
}

/// A sum of two sines with a slope, smooth and different for each index.
struct SmoothNumber {
  double at = 0, slope = 0, amplitude[2] = {0, 0}, rate[2] = {0, 0}, phase[2] = {0, 0};

  SmoothNumber() = default;
  SmoothNumber(const Stream& draw, std::uint64_t index, double size) {
    at = size * draw.Gaussian(index, 20);
    slope = 0.3 * size * draw.Gaussian(index, 21);
    for (int k = 0; k < 2; ++k) {
      amplitude[k] = size * draw.Uniform(index, 22 + k);
      rate[k] = 0.5 + 1.5 * draw.Uniform(index, 24 + k);
      phase[k] = 6 * draw.Uniform(index, 26 + k);
    }
  }
  /// The value, its first or its second derivative.
  double Of(double t, int derivative = 0) const {
    double sum = derivative == 0 ? at + slope * t : derivative == 1 ? slope : 0;
    for (int k = 0; k < 2; ++k) {
      const double angle = rate[k] * t + phase[k];
      sum += derivative == 0   ? amplitude[k] * std::sin(angle)
             : derivative == 1 ? amplitude[k] * rate[k] * std::cos(angle)
                               : -amplitude[k] * rate[k] * rate[k] * std::sin(angle);
    }
    return sum;
  }
};

}  // namespace tera
