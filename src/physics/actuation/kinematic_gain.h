#pragma once

#include "core/types/effects.h"
#include "physics/actuation/over_travel.h"

namespace tera {

/// How a joint's rate follows from its cylinder's. The defaults are proportional.
struct KinematicGainParameters {
  /// Distances of the cylinder's two pins from the joint; 0 without a cylinder. The angle between
  /// them is |angle_at_zero_rad + q|.
  double barrel_m = 0, rod_m = 0;
  double angle_at_zero_rad = 0;
  double reference_rad = 0;  ///< joint position at which the gain is 1
  OverTravel arms_m;         ///< lever arms in place of pins; no values without
  double gap_rad = 0;
};

/// The caller fills in the arms where cylinder_lever has no pins.
KinematicGainParameters KinematicGainOf(const Effects& effects);

/// Slot `kinematic_gain` of one joint or gear.
///
/// Model   cylinder_lever: theta_dot = v / r(theta). A cylinder between pins at distances a and b
///         from the joint, at an angle g to each other, has the length L = sqrt(a^2 + b^2 - 2 a b
///         cos g) and the lever arm r = dL/dg = a b sin(g) / L. The gain is scaled to 1 at a
///         reference position, and at most 10 near a dead centre.
///         backlash: the play operator. The output moves only while the input presses on a side of
///         the gap.
/// Omits   the load's effect on the gap: the actuator's demand crosses it at each of its reversals.
///         In reality a load holds the gap closed on one side and crosses it where the load
///         reverses. Under gravity it almost never does. Also the impact when a gap closes.
/// Source  Visintin 1994, "Differential models of hysteresis": the play operator.
class KinematicGain {
 public:
  /// The gap starts at its middle.
  explicit KinematicGain(const KinematicGainParameters& parameters);

  /// Joint rate over a step of `dt_s` at `position_rad`, for an actuator that runs at `rate_radps`.
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
  double in_gap_rad_ = 0;  ///< position in the gap, from its negative side
};

}  // namespace tera
