#pragma once

#include "soil/soil.h"

namespace tera {

/// Shear of the ground under running gear.
///
/// Model   A shear displacement j, along and across the shoes' travel, mobilises the share 1 -
///         exp(-|j| / K) of the strength, along j. Slip against j unloads at the initial stiffness,
///         so that what a shear has cost is not given back; slip across j turns the stress its way
///         within K where the strength is used up, so that sliding soil resists where it slides to.
/// Source  Janosi and Hanamoto 1961.

/// Stress per unit strength at shear displacement `j_m`.
Vec2 Mobilised(const SoilType& soil, const Vec2& j_m);

/// Shears on by `slip_m`; j grows no further than fully mobilised.
void ShearFurther(const SoilType& soil, const Vec2& slip_m, Vec2* j_m);

/// What the ground has to give where it is sheared.
struct ShearStrength {
  const SoilType& soil;
  double normal_n, area_m2;

  double force_n() const;
};

/// Force on gear whose stress is the share `mobilised` of the strength and whose shear displacement
/// is about `j_m`, with damping that fades as it slips.
Vec2 ShearForce_n(const ShearStrength& strength, const Vec2& mobilised, double j_m,
                  const Vec2& slip_mps);

}  // namespace tera
