#pragma once

#include <optional>

#include "core/types/effects.h"
#include "physics/actuation/over_travel.h"

namespace tera {

/// The most that an actuator can do in either direction, magnitudes over its travel.
struct ActuatorEffort {
  OverTravel positive_nm{.values = {0}}, negative_nm{.values = {0}};
  /// At mid-travel, the mean of both directions.
  double rated_nm = 0;

  /// An actuator with the same effort in both directions, all over its travel.
  static ActuatorEffort Constant(double effort_nm);
};

/// What load and friction do to an actuator. As built, nothing. Efforts are newtons and rates
/// metres a second for a joint that slides.
struct LoadFrictionParameters {
  /// The efforts at which it stands still in either direction; no values: none.
  OverTravel stall_positive_nm, stall_negative_nm;
  double droop_response_s = 0;
  /// Yield to a load that pushes it the negative way, or the positive; no values: none.
  OverTravel drift_negative_radpspnm, drift_positive_radpspnm;
  double coulomb_nm = 0, viscous_nmsprad = 0;
  double stribeck_nm = 0, stribeck_radps = 1;
  double more_positive_nm = 0, more_negative_nm = 0;
  double more_positive_nmsprad = 0, more_negative_nmsprad = 0;
  double offset_nm = 0;
  double lost_radps = 0;            ///< of its rate to dry friction, by a drive that gives way
  double slide_s = 0;               ///< inertia over that drive's damping
  double breakaway = 1;             ///< friction at rest over that in sliding ..
  double slide_stribeck_radps = 1;  ///< .. which it has beyond this rate
  double flex_radps = 0, flex_damping = 0, compliance_radpnm = 0;
};

/// `effort` is what the actuator can do: it stalls there where no number is given, and there its
/// leak is stated.
LoadFrictionParameters LoadFrictionOf(const Effects& effects, const ActuatorEffort& effort);

/// What opposes the motion of an axis over a step: dry friction, which also holds it at rest, with
/// at most these magnitudes in either direction, and the viscous one, which belongs to the rate at
/// the end of the step.
struct AxisFriction {
  double against_positive_nm = 0, against_negative_nm = 0;
  double viscous_nmsprad = 0;

  bool dry() const { return against_positive_nm > 0 || against_negative_nm > 0; }
  bool any() const { return dry() || viscous_nmsprad > 0; }
};

/// Slot `load_friction` of one joint or gear.
///
/// Frames  The load is the effort that the joint needs at a steady rate beside that against its
///         own friction, positive where it must be pushed towards larger positions.
/// Model   pressure_droop: v = v0 sqrt((ps - pL) / ps) with pL / ps the load and the friction
///         against v0 over the effort at which the actuator stalls, which without a number is the
///         most it can do where it stands in that direction, seen through a first-order lag of the
///         oil's compression; an aiding load makes it faster. The pressure that accelerates
///         masses is no load: it is gone within I v0 / ps, some milliseconds. sag: a leak lets the
///         joint yield at a rate proportional to the load beyond what friction holds, w = drift
///         (rated / E)^2 load / rated with E the most it can do where it stands against that load:
///         pressure is load over area and lever arm, and so is the rate over the leak.
///         drive_friction: dry friction that the drive has no stiffness to ignore; it pushes the
///         more the more its rate falls short, T dw/dt = u - w - r(w) sgn w, r = lost (1 + (b - 1)
///         exp(-(w / w_s)^2)), and stands still until |u| is over b times what is lost in sliding.
///         structural_flex: the rate passes a filter of second order, w_n^2 / (s^2 + 2 z w_n s +
///         w_n^2), and so does the angle -c L by which a load L bends the link. Friction: F = F_c +
///         F_s exp(-(w / w_s)^2) + c |w| (coulomb_friction, stribeck_friction, viscous_friction),
///         and more of F_c and c by direction (asymmetric_friction); it opposes motion, and holds a
///         joint at rest with at most F(0). effort_offset: a constant effort that the actuator must
///         make up for, whichever way the joint moves.
/// Omits   that what bends a flexible link includes its own acceleration, presliding displacement,
/// dependence of friction
///         on load; `payload` is a mass of the
///         machine's links (see AddPayloads).
/// Source  Merritt 1967, "Hydraulic control systems", ch. 3 (orifice, laminar leak); Armstrong-
///         Helouvry et al. 1994, "A survey of models, analysis tools and compensation methods for
///         the control of machines with friction".
class LoadFriction {
 public:
  explicit LoadFriction(const LoadFrictionParameters& parameters);

  /// Whether the rate depends on the load.
  bool ReadsLoad() const;
  /// Rate over a step of `dt_s` when the actuator alone would run at `rate_radps`.
  double Step(double rate_radps, double load_nm, double position_rad, double dt_s) {
    return acts_ ? Act(rate_radps, load_nm, position_rad, dt_s) : rate_radps;
  }

  /// The constant effort that the joint needs besides.
  double Offset_nm() const { return parameters_.offset_nm; }
  /// Friction of a joint that moves at `rate_radps`; at rest, the viscous one of both directions.
  AxisFriction Friction(double rate_radps) const;

 private:
  double Act(double rate_radps, double load_nm, double position_rad, double dt_s);
  void Prepare(double dt_s);
  double Droop(double rate_radps, double load_nm, double position_rad);
  double Leak(double load_nm, double position_rad) const;
  double DriveFriction(double rate_radps);
  /// One step of a value that follows another as the link swings.
  void Swing(double towards, double* value, double* change) const;
  double Flex(double rate_radps, double load_nm);

  LoadFrictionParameters parameters_;
  bool acts_;              ///< on the rate
  double pressed_nm_ = 0;  ///< load as the pressure shows it
  double slid_radps_ = 0;
  double flexed_radps_ = 0, flexed_change_radps2_ = 0;  ///< state of the filter
  std::optional<double> bent_rad_;                      ///< by the load; none before the first step
  double bending_radps_ = 0;
  double dt_s_ = 0;  ///< for which the following hold
  double response_step_ = 1, slide_keeps_ = 0, flex_cos_ = 1, flex_sin_ = 0;
};

/// Kinematic viscosity of hydraulic oil ISO VG 46 (viscosity index about 100) at `oil_degc`.
///
/// Model   log10 log10 (nu + 0.7) = A - B log10 T, through 46 cSt at 40 C and 6.8 cSt at 100 C.
/// Source  ASTM D341.
double OilViscosity_cst(double oil_degc);

}  // namespace tera
