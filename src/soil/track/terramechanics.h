#pragma once

#include "soil/soil.h"

/// Closed forms of pressure, sinkage and shear under running gear.
///
/// Source  Bekker 1969, Introduction to Terrain-Vehicle Systems; Janosi and Hanamoto 1961; Wong,
///         Theory of Ground Vehicles, 4th ed. 2008, ch. 2; peaks of pressure: Wills 1963, J. Agric.
///         Eng. Res. 8.

namespace tera {

/// Bekker's pressure under a plate at sinkage `z_m`; `width_m` is its smaller side.
double BekkerPressure_pa(const SoilType& soil, double width_m, double z_m);

/// Work per unit area of pressing a plate from the surface to sinkage `z_m`.
double BekkerWork_jpm2(const SoilType& soil, double width_m, double z_m);

/// Stiffness per unit area of ground that was pressed before: a plate on an elastic half-space.
double Rebound_papm(const SoilType& soil, double width_m);

/// Share of the shear strength that is mobilised at shear displacement `j_m` (Janosi and Hanamoto).
double ShearMobilisation(const SoilType& soil, double j_m);

/// Width of a patch for the pressure-sinkage relation.
double PlateWidth_m(const ContactPatch& patch);

/// Pressure at `along_m` from the middle of a patch, divided by the mean pressure. It is Wills'
/// multi-peak sine 1 + cos(2 pi x / pitch), where x is the distance from a road wheel. Its mean is
/// 1.
double PressureShare(const ContactPatch& patch, double along_m);

/// Resistance of the soil that gear of width b at sinkage z pushes ahead and aside: b (0.67 c z
/// K_pc + rho g z^2 K_pg / 2). K_pc = (N_c - tan phi') cos^2 phi' and K_pg = (2 N_g / tan phi' + 1)
/// cos^2 phi'. The bearing factors are those of local shear, tan phi' = 2/3 tan phi.
/// Source  Bekker 1960, Off-the-Road Locomotion; Wong 2008, ch. 2.
double BulldozingResistance_n(const SoilType& soil, double width_m, double z_m);

/// Distance beside a strip of width b over which displaced soil heaves. It ends at the exit of
/// Prandtl's slip surface for local shear, b sqrt(N_q).
/// Source  Prandtl 1920; Terzaghi 1943.
double HeaveReach_m(const SoilType& soil, double width_m);

/// A vertical face that pushes soil ahead.
///
/// Model   The slip plane rises at X = 45 deg - phi / 2. The resistance per unit length at depth h
///         is (cot X + tan(X + phi)) (c h + rho g h^2 / 2 (cot X + cot^2 X tan phi)). The last term
///         is the soil heaped up on the wedge.
/// Source  Hegedus 1960, as in Ishigami, Miwa, Nagatani and Yoshida 2007, J. Field Robotics 24(3).
class PushedFace {
 public:
  explicit PushedFace(const SoilType& soil);

  double Resistance_npm(double depth_m) const;
  /// Effective depth of a face `depth_m` below ground with `loose_m` of loose soil. Resistance_npm
  /// already includes soil heaped on the wedge, h / 2 cot X tan phi high on average. So loose soil
  /// up to that height does not add to the depth.
  double Depth_m(double depth_m, double loose_m) const;
  /// Length of the wedge in front of a face of depth `depth_m`.
  double Wedge_m(double depth_m) const { return depth_m * cot_; }

 private:
  double cot_, tan_phi_;  ///< cot X, which equals tan(X + phi); tan phi
  double cohesion_pa_, weight_npm3_;
};

/// Shear of the ground under running gear.
///
/// Model   A shear displacement j, along and across the travel of the shoes, mobilises the share 1
///         - exp(-|j| / K) of the strength, along j. Slip against j unloads at the initial
///         stiffness, so that the work of shear is not returned. Slip across j turns the stress
///         towards the slip, within K at full strength. So sliding soil resists in its direction of
///         sliding.
/// Source  Janosi and Hanamoto 1961.

/// Stress over strength at shear displacement `j_m`.
Vec2 Mobilised(const SoilType& soil, const Vec2& j_m);

/// Advances the shear displacement by a slip. |j| is limited to a value of nearly full strength.
void ShearFurther(const SoilType& soil, const Vec2& slip_m, Vec2* j_m);

/// Shear strength of a loaded area of ground.
struct ShearStrength {
  const SoilType& soil;
  double tan_friction;  ///< of the shear friction angle
  double normal_n, area_m2;

  double force_n() const { return soil.shear_cohesion_pa * area_m2 + normal_n * tan_friction; }
};

/// Shear force on the gear. `mobilised` is the stress divided by the strength, `j_m` the shear
/// displacement. Damping fades with the slip speed.
Vec2 ShearForce_n(const ShearStrength& strength, const Vec2& mobilised, double j_m,
                  const Vec2& slip_mps);

}  // namespace tera
