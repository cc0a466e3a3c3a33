#pragma once

#include "soil/soil.h"

/// Closed forms of pressure, sinkage and shear under running gear.
///
/// Source  Bekker 1969, Introduction to Terrain-Vehicle Systems; Janosi and Hanamoto 1961; Wong,
///         Theory of Ground Vehicles, 4th ed. 2008, ch. 2.

namespace tera {

/// Bekker: pressure under a plate of smaller side `width_m` at sinkage `z_m`.
double BekkerPressure_pa(const SoilType& soil, double width_m, double z_m);

/// Inverse of BekkerPressure_pa.
double BekkerSinkage_m(const SoilType& soil, double width_m, double pressure_pa);

/// Work per unit area of pressing a plate from the surface to sinkage `z_m`.
double BekkerWork_jpm2(const SoilType& soil, double width_m, double z_m);

/// Stiffness, per unit area, of ground that was pressed before: a plate on an elastic half space.
double Rebound_papm(const SoilType& soil, double width_m);

/// Janosi–Hanamoto: share of the shear strength that is mobilised after shearing by `j_m`.
double ShearMobilisation(const SoilType& soil, double j_m);

/// Thrust of a track of contact area `width_m` x `length_m` under `load_n`, evenly spread, at slip
/// `slip` in (0, 1], whose shear displacement grows linearly from its front.
double TrackThrust_n(const SoilType& soil, double width_m, double length_m, double load_n,
                     double slip);

/// Resistance of the rut that a track of width `width_m` presses to sinkage `z_m`.
double CompactionResistance_n(const SoilType& soil, double width_m, double z_m);

}  // namespace tera
