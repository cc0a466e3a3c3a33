#pragma once

#include "soil/soil.h"

/// Closed forms of pressure, sinkage and shear under running gear.
///
/// Source  Bekker 1969, Introduction to Terrain-Vehicle Systems; Janosi and Hanamoto 1961; Wong,
///         Theory of Ground Vehicles, 4th ed. 2008, ch. 2; peaks of pressure: Wills 1963, J. Agric.
///         Eng. Res. 8.

namespace tera {

/// Bekker: pressure under a plate of smaller side `width_m` at sinkage `z_m`.
double BekkerPressure_pa(const SoilType& soil, double width_m, double z_m);

/// Work per unit area of pressing a plate from the surface to sinkage `z_m`.
double BekkerWork_jpm2(const SoilType& soil, double width_m, double z_m);

/// Stiffness, per unit area, of ground that was pressed before: a plate on an elastic half space.
double Rebound_papm(const SoilType& soil, double width_m);

/// Janosi–Hanamoto: share of the shear strength that is mobilised after shearing by `j_m`.
double ShearMobilisation(const SoilType& soil, double j_m);

/// Width of a patch that the pressure-sinkage relation sees.
double PlateWidth_m(const ContactPatch& patch);

/// Pressure at `along_m` (along travel) from a patch's middle over the mean pressure: Wills'
/// multi-peak sine 1 + cos(2 pi x / pitch), x the distance from a road wheel. Its mean is 1.
double PressureShare(const ContactPatch& patch, double along_m);

/// Resistance of the soil that running gear of width `width_m`, sunk to `z_m`, pushes before it and
/// aside: b (0.67 c z K_pc + rho g z^2 K_pg / 2), with K_pc = (N_c - tan phi') cos^2 phi', K_pg =
/// (2 N_g / tan phi' + 1) cos^2 phi' and the bearing factors of local shear, tan phi' = 2/3 tan
/// phi. Source: Bekker 1960, Off-the-Road Locomotion; Wong 2008, ch. 2.
double BulldozingResistance_n(const SoilType& soil, double width_m, double z_m);

/// Reach, beside a strip of width `width_m`, of the heave of soil that it does not press together.
/// It ends at the exit of Prandtl's slip surface, b sqrt(N_q), of local shear. Source: Prandtl
/// 1920; Terzaghi 1943.
double HeaveReach_m(const SoilType& soil, double width_m);

/// An upright face that pushes soil before it.
///
/// Model   The slip plane rises at X = 45 deg - phi / 2. Resistance per unit length at depth h:
///         (cot X + tan(X + phi)) (c h + rho g h^2 / 2 (cot X + cot^2 X tan phi)), the last term
///         the soil that has heaped up on the wedge.
/// Source  Hegedus 1960, as in Ishigami, Miwa, Nagatani and Yoshida 2007, J. Field Robotics 24(3).
class PushedFace {
 public:
  explicit PushedFace(const SoilType& soil);

  double Resistance_npm(double depth_m) const;
  /// Depth that counts of a face that stands `depth_m` below ground of which `loose_m` lies loose:
  /// the soil that has heaped up on the wedge, h / 2 cot X tan phi high on average, counts once.
  double Depth_m(double depth_m, double loose_m) const;
  /// Length of the wedge before a face that stands `depth_m` deep.
  double Wedge_m(double depth_m) const { return depth_m * cot_; }

 private:
  double cot_, tan_phi_;  ///< of X, which is tan(X + phi) too; of phi
  double cohesion_pa_, weight_npm3_;
};

/// Shear of the ground under running gear.
///
/// Model   A shear displacement j, along and across the shoes' travel, mobilises the share 1 -
///         exp(-|j| / K) of the strength, along j. Slip against j unloads at the initial stiffness,
///         so that the work of a shear is not given back. Slip across j turns the stress its way
///         within K where the strength is used up. So sliding soil resists in its direction of
///         sliding.
/// Source  Janosi and Hanamoto 1961.

/// Stress per unit strength at shear displacement `j_m`.
Vec2 Mobilised(const SoilType& soil, const Vec2& j_m);

/// Shears on by `slip_m`; j grows no further than fully mobilised.
void ShearFurther(const SoilType& soil, const Vec2& slip_m, Vec2* j_m);

/// Strength of the ground where it is sheared.
struct ShearStrength {
  const SoilType& soil;
  double tan_friction;  ///< of the soil's shear
  double normal_n, area_m2;

  double force_n() const { return soil.shear_cohesion_pa * area_m2 + normal_n * tan_friction; }
};

/// Force on gear whose stress is the share `mobilised` of the strength and whose shear displacement
/// is about `j_m`, with damping that fades as it slips.
Vec2 ShearForce_n(const ShearStrength& strength, const Vec2& mobilised, double j_m,
                  const Vec2& slip_mps);

}  // namespace tera
