#pragma once

#include <array>

#include "blind/mujoco/sensors/sensors_form.h"

namespace tera::blind::mujoco {

/// What a unit feels on a plate that its weight bends.
///
/// Model   The plate turns the unit about the link's x or y by an angle b,
///         T b' = bends f_z / g - b, f_z being the specific force along the link's z, T = 0.03 s.
///         The unit reads rate and force in its own axes, and b' beside.
/// Omits   the plate's own ringing; that the unit moves by its bending.
class Bracket {
 public:
  /// At rest, bent by `force_mps2`.
  Bracket(const BracketForm& form, const Vec3& force_mps2);

  /// Rate and specific force, a step after those before.
  std::array<double, 6> Felt(const std::array<double, 6>& of_link, double step_s);

 private:
  BracketForm form_;
  double bent_rad_;
};

}  // namespace tera::blind::mujoco
