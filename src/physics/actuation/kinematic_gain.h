#pragma once

#include "core/types/effects.h"
#include "physics/actuation/over_travel.h"

namespace tera {

/// How a joint's rate follows from its cylinder's. As built, in proportion.
struct KinematicGainParameters {
  /// Distances of the cylinder's two pins from the joint, 0 without; the angle between them is
  /// |angle_at_zero_rad + q|.
  double barrel_m = 0, rod_m = 0;
  double angle_at_zero_rad = 0;
  double reference_rad = 0;  ///< joint position at which the gain is 1
  OverTravel arms_m;         ///< lever arms in place of pins, no values without
  double gap_rad = 0;
};

/// Where cylinder_lever has no pins, the arms are left to be filled in.
KinematicGainParameters KinematicGainOf(const Effects& effects);

/// Slot `kinematic_gain` of one joint or gear.
///
/// Model   cylinder_lever: theta_dot = v / r(theta), where a cylinder between pins at distances a
///         and b from the joint, apart by the angle g, has the length L = sqrt(a^2 + b^2 - 2 a b
///         cos g) and the lever arm r = dL/dg = a b sin(g) / L; scaled to 1 at a reference
///         position, and at most 10 near a dead centre. backlash: the play operator, what moves
///         behind a gap moves only while what moves before it presses on one of its sides.
/// Omits   the load: it is what the actuator asks for that crosses the gap, at each of its
///         reversals. A gap that a load holds closed on one side is crossed where the load
///         reverses, under gravity hardly ever. The impact when a gap closes.
/// Source  Visintin 1994, "Differential models of hysteresis": the play operator.
class KinematicGain {
 public:
  /// The gap starts half open to either side.
  explicit KinematicGain(const KinematicGainParameters& parameters);

  /// Rate over a step of `dt_s` of the joint at `position_rad` whose actuator runs at `rate_radps`.
  double Step(double rate_radps, double position_rad, double dt_s) {
    return acts_ ? Act(rate_radps, position_rad, dt_s) : rate_radps;
  }

  /// r(reference) / r(position).
  double Gain(double position_rad) const;
  /// r(reference); 0 without a cylinder.
  double reference_arm_m() const { return reference_arm_m_; }
  /// Whether cylinder_lever acts.
  bool HasLever() const { return parameters_.rod_m > 0 || !parameters_.arms_m.values.empty(); }

 private:
  double Act(double rate_radps, double position_rad, double dt_s);

  KinematicGainParameters parameters_;
  bool acts_ = false;
  double reference_arm_m_ = 0;
  double in_gap_rad_ = 0;  ///< from the gap's negative side
};

}  // namespace tera
