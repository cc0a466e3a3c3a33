#pragma once

#include <vector>

#include "core/types/ground_tools.h"
#include "soil/columns/soil_type.h"
#include "soil/soil.h"
#include "soil/track/terramechanics.h"

namespace tera {

/// A patch of running gear on one soil, with all constants of the pair computed once.
///
/// Source  terramechanics.h.
class Plate {
 public:
  /// `soil` must outlive this object.
  Plate(const SoilType& soil, const ContactPatch& patch);

  const SoilType& soil() const { return *soil_; }
  /// Shear strength of the ground under a normal load on an area.
  ShearStrength Strength(double normal_n, double area_m2) const {
    return {*soil_, tan_friction_, normal_n, area_m2};
  }
  /// The soil beside the patch, as its side face pushes it.
  const PushedFace& face() const { return face_; }
  double width_m() const { return width_m_; }
  double rebound_papm() const { return rebound_papm_; }
  /// Distance beside the patch over which soil heaves, see HeaveReach_m.
  double heave_reach_m() const { return heave_reach_m_; }
  /// Pressure of the ground at sinkage `z_m`: Bekker's, limited by LimitUnderGear.
  double Pressure_pa(double z_m) const;
  /// True if Pressure_pa(z_m) is at least `pressure_pa`. Cheap bounds of the logarithm decide most
  /// cases, single precision nearly all others.
  bool Bears(double pressure_pa, double z_m) const;
  /// Pressure on a point with penetration `pen_m` that moves into the ground at `into_mps`. It is s
  /// k_e pen, limited by Pressure_pa(bearing_m), plus damping. `share` is s.
  double DampedPressure_pa(double share, double pen_m, double bearing_m, double into_mps) const;
  /// Solves s k_e (pen - ds) = Pressure_pa(ease (pressed + ds)) for ds by safeguarded Newton steps.
  /// Returns 0 if the ground bears the plate elastically. `ease` is the share of Rolling.
  double PlasticSinkage_m(double share, double ease, double pressed_m, double pen_m) const;
  /// Work per unit area of pressing from sinkage `from_m` to the close `to_m`.
  double PressingWork_jpm2(double from_m, double to_m) const;
  /// Work per unit area of pushing soil aside from sinkage `from_m` to `to_m`.
  double BulldozingWork_jpm2(double from_m, double to_m) const;

 private:
  const SoilType* soil_;
  double tan_friction_;
  PushedFace face_;
  double width_m_;
  double rebound_papm_;  ///< elastic stiffness k_e
  double heave_reach_m_;
  BearingLimit limit_;
  float modulus_npm_n2_, exponent_;
  /// bulldozing resistance over width: coefficients of z and z^2
  double pushed_npm2_, pushed_npm3_;
};

/// One plate for each soil, for each patch of the gear: index patch * soils.size() + soil.
std::vector<Plate> PlatesOf(const RunningGear& gear, const std::vector<SoilType>& soils);

}  // namespace tera
