#pragma once

#include <array>

/// How much dust soil gives off when it is handled, driven over and blown.
///
/// Source  U.S. EPA, AP-42, Compilation of Air Pollutant Emission Factors, fifth edition: section
///         13.2.4 (Aggregate handling and storage piles, 2006), 13.2.2 (Unpaved roads, 2006),
///         13.2.5 (Industrial wind erosion, 2006), 11.9 (Western surface coal mining, 1998).

namespace tera {

/// Kilograms (or kilograms per something) of particles by aerodynamic diameter: up to 2.5 um, 2.5
/// to 10 um, 10 to 30 um.
constexpr int kDustSizes = 3;
using DustMass = std::array<double, kDustSizes>;

/// Of a tonne of soil that is dropped, 13.2.4 equation 1: k 0.0016 (U / 2.2)^1.3 / (M / 2)^1.4
/// kg/t. Wind and moisture beyond what the equation rests on (0.6 to 6.7 m/s, 0.25 to 4.8 %) count
/// as its bounds, but for soil that is wetter: the equation goes on.
DustMass DropEmission_kgpt(double wind_mps, double moisture_percent);

/// A fall of another height than the bucket loads and dumps behind that equation, taken as 1.5 m:
/// (h / 1.5 m)^0.7, as a dragline's drop in table 11.9-2.
double DropHeightFactor(double fall_m);

/// Of a kilometre that a vehicle drives over dry unpaved ground, 13.2.2 equation 1a: k (s / 12)^a
/// (W / 3)^b lb/mile, W in short tons.
DustMass RoadEmission_kgpkm(double silt_percent, double vehicle_kg);

/// What is left of that where the ground is moister than `dry_percent`, figure 13.2.2-2: a quarter
/// at twice the moisture, a twentieth at five times, between them linear; beyond, that twentieth
/// over the square of the ratio to five.
double MoistRoadShare(double moisture_percent);

/// What wind takes from each square metre of loose soil in all after it was disturbed, 13.2.5
/// equation 3: 58 (u* - u*t)^2 + 25 (u* - u*t) g/m^2.
double ErosionPotential_gpm2(double friction_velocity_mps, double threshold_mps);
/// That mass by size.
DustMass WindErosion_kg(double potential_kg);

/// Friction velocity of a wind 10 m above the ground, over a roughness of 5 mm (13.2.5): 0.4 /
/// ln(10 m / 5 mm) of it.
double FrictionVelocity_mps(double wind_10m_mps);

/// Water over dry soil, by mass, of soil with that degree of saturation: S (1 / rho - 1 / rho_s)
/// rho_w with grains of 2650 kg/m^3.
double WaterByMass_percent(double saturation, double bank_density_kgpm3);

/// Speed at which a sphere falls in still air, by Stokes: rho d^2 g / (18 mu), 18.1 uPa s.
double StokesSpeed_mps(double diameter_m, double density_kgpm3);

}  // namespace tera
