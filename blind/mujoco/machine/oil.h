#pragma once

#include <array>
#include <cstddef>
#include <string>

namespace tera::blind::mujoco {

/// The spring of a drive's oil with what it moves, which no owner's file says.
struct OilNumbers {
  double natural_radps = 70;
  double damping = 0.5;  ///< of critical
};

/// By axis, of the machine that an owner's file calls `kind`.
///
/// Model   A small machine's oil is stiff: short hoses, light links. The heavier what a joint
///         moves, the slower it swings. After a step, x'' + 2 z w x' + w^2 x = w^2, the area of the
///         squared error is (1 + 4 z^2) / (4 z w), which is that of a delay by as much: with the
///         pilot and the bus less than what is as expected.
/// Omits   that the inertia, and with it the frequency, changes with the pose.
std::array<OilNumbers, 6> OilOf(const std::string& kind);

}  // namespace tera::blind::mujoco
