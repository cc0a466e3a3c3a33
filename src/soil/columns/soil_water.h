#pragma once

#include "soil/soil.h"

/// Water in the pores of a soil, and its effect on the soil's strength.
///
/// Source  van Genuchten 1980, Soil Sci. Soc. Am. J. 44; Mualem 1976; Lu and Likos 2006, J.
///         Geotech. Geoenviron. Eng. 132; Das, Principles of Geotechnical Engineering, ch. 3.

namespace tera {

inline constexpr double kWater_kgpm3 = 1000, kGrains_kgpm3 = 2650;

/// Void ratio over one plus void ratio, of soil of that bulk density.
double Porosity(double density_kgpm3, double moisture);

/// Hydraulic conductivity at a degree of saturation: K_s sqrt(S_e) (1 - (1 - S_e^(1/m))^m)^2, m =
/// 1 - 1/n.
double Conductivity_mps(const SoilWater& water, double moisture);

/// Degree of saturation that suction of so many metres of water leaves.
double MoistureAt(const SoilWater& water, double suction_m);

/// Suction's part of the stress between grains: S_e times the suction, which is at most that at
/// which plants wilt, 1.5 MPa.
double SuctionStress_pa(const SoilWater& water, double moisture);

/// The soil at another degree of saturation.
///
/// Model   Its pores stay, and water that they gain adds to the bulk density. Cohesion, of cuts and
///         of gear, changes by tan phi times the change of the suction stress, and is never
///         negative. Moduli, of elasticity and of pressure and sinkage, change as the root of the
///         stress between grains. This is suction plus the 10 kPa of PressedDensity_kgpm3.
/// Omits   friction stays (Lu and Likos); swelling; repose and fast flow of dug soil.
/// Source  cohesion: Lu and Likos 2006; moduli: Hardin and Black 1968, J. Soil Mech. Found. Div.
///         ASCE 94, and Janbu 1963.
SoilType AtMoisture(const SoilType& soil, double moisture);

}  // namespace tera
