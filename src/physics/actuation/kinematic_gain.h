#pragma once

#include "core/types/effects.h"
#include "physics/actuation/over_travel.h"

namespace tera {

/// Relation between the rates of a joint and its cylinder. The defaults are proportional.
struct KinematicGainParameters {
  /// Distances of the cylinder's two pins from the joint; 0 without a cylinder. The angle between
  /// them is |angle_at_zero_rad + q|.
  double barrel_m = 0, rod_m = 0;
  double angle_at_zero_rad = 0;
  double reference_rad = 0;  ///< joint position at which the gain is 1
  OverTravel arms_m;         ///< lever arms instead of pins; no values if unused
  double gap_rad = 0;
};

/// Without pins in cylinder_lever, the caller must fill in the arms.
KinematicGainParameters KinematicGainOf(const Effects& effects);

/// Slot `kinematic_gain` of one joint or gear.
///
/// Model   cylinder_lever: theta_dot = v / r(theta). The pins of a cylinder are at distances a and
///         b from the joint, at an angle g. The length is L = sqrt(a^2 + b^2 - 2 a b cos g) and the
///         lever arm r = dL/dg = a b sin(g) / L. The gain is scaled to 1 at a reference position,
///         and is at most 10 near a dead centre.
///         backlash: the play operator. The output moves only while the input is at a side of the
///         gap.
/// Omits   Effect of the load on the gap: here the demand crosses the gap at each reversal. In
///         reality a load keeps the gap closed on one side and crosses it where the load reverses,
///         which gravity rarely allows. The impact when a gap closes.
/// Source  Visintin 1994, "Differential models of hysteresis": the play operator.
class KinematicGain {
 public:
  /// The gap starts in its middle position.
  explicit KinematicGain(const KinematicGainParameters& parameters);

  /// Rate of the joint over a step of `dt_s` at `position_rad`, for an actuator at `rate_radps`.
  double Step(double rate_radps, double position_rad, double dt_s) {
    return acts_ ? Act(rate_radps, position_rad, dt_s) : rate_radps;
  }

  /// r(reference) / r(position).
  double Gain(double position_rad) const;
  /// r(reference); 0 without a cylinder.
  double reference_arm_m() const { return reference_arm_m_; }
  /// True if cylinder_lever acts.
  bool HasLever() const { return parameters_.rod_m > 0 || !parameters_.arms_m.values.empty(); }

 private:
  double Act(double rate_radps, double position_rad, double dt_s);

  KinematicGainParameters parameters_;
  bool acts_ = false;
  double reference_arm_m_ = 0;
  double in_gap_rad_ = 0;  ///< position in the gap, from its negative side
};

}  // namespace tera
