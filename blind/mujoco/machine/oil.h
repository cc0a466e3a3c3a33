#pragma once

#include <array>
#include <cstddef>
#include <string>

namespace tera::blind::mujoco {

/// Spring of a drive's oil with the moved mass. No owner's file has it.
struct OilNumbers {
  double natural_radps = 70;
  double damping = 0.5;  ///< damping ratio
};

/// Oil by axis, for the machine that an owner's file calls `kind`.
///
/// Model   A small machine's oil is stiff: short hoses, light links. The heavier the moved parts,
///         the lower the frequency. After a step, x'' + 2 z w x' + w^2 x = w^2, the area of the
///         squared error is (1 + 4 z^2) / (4 z w), equal to that of a delay of this length. With
///         the pilot and the bus it stays within the expected deviation.
/// Omits   dependence of the inertia, and so of the frequency, on the pose.
std::array<OilNumbers, 6> OilOf(const std::string& kind);

}  // namespace tera::blind::mujoco
