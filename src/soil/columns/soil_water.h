#pragma once

#include "soil/soil.h"

/// Water in the pores of a soil, and its effect on the strength of the soil.
///
/// Source  van Genuchten 1980, Soil Sci. Soc. Am. J. 44; Mualem 1976; Lu and Likos 2006, J.
///         Geotech. Geoenviron. Eng. 132; Das, Principles of Geotechnical Engineering, ch. 3.

namespace tera {

inline constexpr double kWater_kgpm3 = 1000, kGrains_kgpm3 = 2650;

/// e / (1 + e), where e is the void ratio at a bulk density and degree of saturation.
double Porosity(double density_kgpm3, double moisture);

/// Hydraulic conductivity at a degree of saturation:
/// K_s sqrt(S_e) (1 - (1 - S_e^(1/m))^m)^2, m = 1 - 1/n.
double Conductivity_mps(const SoilWater& water, double moisture);

/// Degree of saturation at a suction, given as a height of water.
double MoistureAt(const SoilWater& water, double suction_m);

/// Suction stress: S_e times the suction. The suction is at most 1.5 MPa, the wilting point of
/// plants.
double SuctionStress_pa(const SoilWater& water, double moisture);

/// The soil at another degree of saturation.
///
/// Model   The porosity stays; gained water adds to the bulk density. Cohesion changes by tan phi
///         times the change of the suction stress, and is at least 0. This holds for the cohesion
///         of cuts and for that of running gear. Young's modulus and the Bekker moduli scale with
///         the square root of the stress between grains. That stress is the suction stress plus the
///         10 kPa of PressedDensity_kgpm3.
/// Omits   Change of friction (Lu and Likos), swelling, change of the repose and fast flow of dug
///         soil.
/// Source  cohesion: Lu and Likos 2006; moduli: Hardin and Black 1968, J. Soil Mech. Found. Div.
///         ASCE 94, and Janbu 1963.
SoilType AtMoisture(const SoilType& soil, double moisture);

}  // namespace tera
