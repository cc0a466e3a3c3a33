#pragma once

#include <array>

#include "blind/mujoco/sensors/sensors_form.h"

namespace tera::blind::mujoco {

/// Readings of a unit on a plate that bends under its weight.
///
/// Model   The plate turns the unit about the link's x or y by an angle b, T b' = bends f_z / g -
///         b. f_z is the specific force along the link's z, T = 0.03 s. The unit reads rate and
///         force in its own axes, plus b'.
/// Omits   the plate's own ringing; the unit's displacement by the bending.
class Bracket {
 public:
  /// Starts at rest, bent by `force_mps2`.
  Bracket(const BracketForm& form, const Vec3& force_mps2);

  /// Rate and specific force, one step after the previous call.
  std::array<double, 6> Felt(const std::array<double, 6>& of_link, double step_s);

 private:
  BracketForm form_;
  double bent_rad_;
};

}  // namespace tera::blind::mujoco
