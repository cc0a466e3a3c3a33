#pragma once

#include <optional>

#include "core/types/effects.h"
#include "physics/actuation/over_travel.h"

namespace tera {

/// Greatest effort of an actuator in either direction, as magnitudes over its travel.
struct ActuatorEffort {
  OverTravel positive_nm{.values = {0}}, negative_nm{.values = {0}};
  /// At mid-travel, the mean of both directions.
  double rated_nm = 0;

  /// An actuator with the same effort in both directions and over its whole travel.
  static ActuatorEffort Constant(double effort_nm);
};

/// Effects of load and friction on an actuator; the defaults have none. For a prismatic joint,
/// efforts are in newtons and rates in metres per second.
struct LoadFrictionParameters {
  /// Stall efforts in either direction; without values there is no stall.
  OverTravel stall_positive_nm, stall_negative_nm;
  double droop_response_s = 0;
  /// Drift rate per load, for drift in the negative and in the positive direction. Without values
  /// there is no drift.
  OverTravel drift_negative_radpspnm, drift_positive_radpspnm;
  double coulomb_nm = 0, viscous_nmsprad = 0;
  double stribeck_nm = 0, stribeck_radps = 1;
  double more_positive_nm = 0, more_negative_nm = 0;
  double more_positive_nmsprad = 0, more_negative_nmsprad = 0;
  double offset_nm = 0;
  double lost_radps = 0;            ///< rate lost to dry friction in a compliant drive
  double slide_s = 0;               ///< inertia over damping of that drive
  double breakaway = 1;             ///< static over sliding friction
  double slide_stribeck_radps = 1;  ///< rate above which sliding friction applies
  double flex_radps = 0, flex_damping = 0, compliance_radpnm = 0;
};

/// `effort` is the greatest effort of the actuator. It is the reference of the leak, and also the
/// stall effort if the effect gives no stall effort.
LoadFrictionParameters LoadFrictionOf(const Effects& effects, const ActuatorEffort& effort);

/// Friction on an axis over a step. Dry friction is at most these magnitudes in either direction
/// and also holds the axis at rest. Viscous friction belongs to the rate at the end of the step.
struct AxisFriction {
  double against_positive_nm = 0, against_negative_nm = 0;
  double viscous_nmsprad = 0;

  bool dry() const { return against_positive_nm > 0 || against_negative_nm > 0; }
  bool any() const { return dry() || viscous_nmsprad > 0; }
};

/// Slot `load_friction` of one joint or gear.
///
/// Frames  The load is the effort of a steady rate without the friction of the joint. It is
///         positive if the joint must be pushed towards larger positions.
/// Model   The mechanisms are:
///         - pressure_droop: v = v0 sqrt((ps - pL) / ps). pL / ps is load plus friction against v0,
///           over the stall effort. It passes a first-order lag for the compression of the oil. By
///           default, the stall effort is the greatest effort of the actuator at that position and
///           direction. An assisting load makes the joint faster. Pressure that accelerates masses
///           is no load: it vanishes within I v0 / ps, some milliseconds.
///         - sag: a leak lets the joint drift in proportion to the load that friction does not
///           hold, w = drift (rated / E)^2 load / rated. E is the greatest effort at that position
///           against that load. Pressure and rate both scale with 1 / (area times lever arm), hence
///           the square.
///         - drive_friction: dry friction in a compliant drive, whose push grows with the missing
///           rate. T dw/dt = u - w - r(w) sgn w with r = lost (1 + (b - 1) exp(-(w / w_s)^2)). The
///           axis stands still until |u| exceeds b times the loss in sliding.
///         - structural_flex: the rate passes the second-order filter w_n^2 / (s^2 + 2 z w_n s +
///           w_n^2). The angle -c L by which a load L bends the link passes it too.
///         - Friction: F = F_c + F_s exp(-(w / w_s)^2) + c |w| (coulomb_friction,
///           stribeck_friction, viscous_friction). F_c and c are greater in one direction
///           (asymmetric_friction). Friction opposes motion, and holds a joint at rest with at most
///           F(0).
///         - effort_offset: a constant effort that the actuator must also supply, for either
///           direction of motion.
/// Omits   Bending by the acceleration of a flexible link itself; presliding displacement;
///         dependence of friction on load. `payload` is a mass of the machine's links (see
///         AddPayloads).
/// Source  Merritt 1967, "Hydraulic control systems", ch. 3 (orifice, laminar leak);
///         Armstrong-Helouvry et al. 1994, "A survey of models, analysis tools and compensation
///         methods for the control of machines with friction".
class LoadFriction {
 public:
  explicit LoadFriction(const LoadFrictionParameters& parameters);

  /// True if the rate depends on the load.
  bool ReadsLoad() const;
  /// Rate over a step of `dt_s`, for an actuator that would run at `rate_radps` without load and
  /// friction.
  double Step(double rate_radps, double load_nm, double position_rad, double dt_s) {
    return acts_ ? Act(rate_radps, load_nm, position_rad, dt_s) : rate_radps;
  }

  /// Constant effort that the joint also needs.
  double Offset_nm() const { return parameters_.offset_nm; }
  /// Friction of a joint that moves at `rate_radps`. At rest, it contains the viscous coefficient
  /// common to both directions.
  AxisFriction Friction(double rate_radps) const;

 private:
  double Act(double rate_radps, double load_nm, double position_rad, double dt_s);
  void Prepare(double dt_s);
  double Droop(double rate_radps, double load_nm, double position_rad);
  double Leak(double load_nm, double position_rad) const;
  double DriveFriction(double rate_radps);
  /// One step of the link's second-order filter, from `*value` towards `towards`.
  void Swing(double towards, double* value, double* change) const;
  double Flex(double rate_radps, double load_nm);

  LoadFrictionParameters parameters_;
  bool acts_;              ///< the rate is affected
  double pressed_nm_ = 0;  ///< load as it appears in the oil pressure
  double slid_radps_ = 0;
  double flexed_radps_ = 0, flexed_change_radps2_ = 0;  ///< state of the filter
  /// Angle of bending; empty before the first step.
  std::optional<double> bent_rad_;
  double bending_radps_ = 0;
  double dt_s_ = 0;  ///< step length of the following values
  double response_step_ = 1, slide_keeps_ = 0, flex_cos_ = 1, flex_sin_ = 0;
};

/// Kinematic viscosity of hydraulic oil ISO VG 46 (viscosity index about 100) at `oil_degc`.
///
/// Model   log10 log10 (nu + 0.7) = A - B log10 T, through 46 cSt at 40 C and 6.8 cSt at 100 C.
/// Source  ASTM D341.
double OilViscosity_cst(double oil_degc);

}  // namespace tera
