#pragma once

#include <vector>

#include "core/types/ground_tools.h"
#include "soil/columns/soil_type.h"
#include "soil/soil.h"
#include "soil/track/terramechanics.h"

namespace tera {

/// A patch of running gear on one of the soils: what they do to each other, all that does not
/// change looked up.
///
/// Source  as in terramechanics.h.
class Plate {
 public:
  /// `soil` outlives it.
  Plate(const SoilType& soil, const ContactPatch& patch);

  const SoilType& soil() const { return *soil_; }
  /// Strength of the ground against shear under that load.
  ShearStrength Strength(double normal_n, double area_m2) const {
    return {*soil_, tan_friction_, normal_n, area_m2};
  }
  /// The soil beside the patch, pushed by its side face.
  const PushedFace& face() const { return face_; }
  double width_m() const { return width_m_; }
  double rebound_papm() const { return rebound_papm_; }
  /// How far beside it soil heaves, see HeaveReach_m.
  double heave_reach_m() const { return heave_reach_m_; }
  /// Pressure of the ground at sinkage `z_m`: Bekker's, at most the bearing limit (LimitUnderGear).
  double Pressure_pa(double z_m) const;
  /// Whether that is at least `pressure_pa`. A glance at the logarithm tells in most cases, single
  /// precision in nearly all.
  bool Bears(double pressure_pa, double z_m) const;
  /// Pressure of the ground on a point that is `pen_m` in it and goes further at `into_mps`, s k_e
  /// pen at most Pressure_pa at a depth of `bearing_m`, damped. `share` is s.
  double DampedPressure_pa(double share, double pen_m, double bearing_m, double into_mps) const;
  /// Solves s k_e (pen - ds) = Pressure_pa(ease (pressed + ds)) for ds by safeguarded Newton steps;
  /// 0 where the ground bears the plate elastically. For `ease` see Rolling.
  double PlasticSinkage_m(double share, double ease, double pressed_m, double pen_m) const;
  /// Work per unit area of pressing from sinkage `from_m` to `to_m`, near by.
  double PressingWork_jpm2(double from_m, double to_m) const;
  /// Work per unit area of pushing soil aside from sinkage `from_m` to `to_m`.
  double BulldozingWork_jpm2(double from_m, double to_m) const;

 private:
  const SoilType* soil_;
  double tan_friction_;
  PushedFace face_;
  double width_m_;
  double rebound_papm_;  ///< k_e
  double heave_reach_m_;
  BearingLimit limit_;
  float modulus_npm_n2_, exponent_;
  double pushed_npm2_, pushed_npm3_;  ///< bulldozing resistance over width: its terms in z and z^2
};

/// For each patch of the gear, one for each soil.
std::vector<Plate> PlatesOf(const RunningGear& gear, const std::vector<SoilType>& soils);

}  // namespace tera
