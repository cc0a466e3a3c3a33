#pragma once

#include <array>

/// Dust emission of soil from handling, driving and wind.
///
/// Source  U.S. EPA, AP-42, Compilation of Air Pollutant Emission Factors, fifth edition: section
///         13.2.4 (Aggregate handling and storage piles, 2006), 13.2.2 (Unpaved roads, 2006),
///         13.2.5 (Industrial wind erosion, 2006), 11.9 (Western surface coal mining, 1998).

namespace tera {

/// Mass (or mass per another quantity) of particles by aerodynamic diameter, kg: up to 2.5 um, 2.5
/// to 10 um, 10 to 30 um.
constexpr int kDustSizes = 3;
using DustMass = std::array<double, kDustSizes>;

/// Emission of a tonne of dropped soil, 13.2.4 equation 1: k 0.0016 (U / 2.2)^1.3 / (M / 2)^1.4
/// kg/t. Wind and moisture are clamped to the equation's range (0.6 to 6.7 m/s, 0.25 to 4.8 %),
/// except for wetter soil, where the equation continues.
DustMass DropEmission_kgpt(double wind_mps, double moisture_percent);

/// Correction for the fall height: (h / 1.5 m)^0.7, as a dragline's drop in table 11.9-2. The
/// equation of DropEmission_kgpt rests on bucket loads and dumps, taken as falls of 1.5 m.
double DropHeightFactor(double fall_m);

/// Emission of a vehicle per kilometre on dry unpaved ground, 13.2.2 equation 1a: k (s / 12)^a (W /
/// 3)^b lb/mile, W in short tons.
DustMass RoadEmission_kgpkm(double silt_percent, double vehicle_kg);

/// Share of the road emission on ground moister than `dry_percent`, figure 13.2.2-2: a quarter at
/// twice the moisture, a twentieth at five times, linear in between. Beyond, the twentieth is
/// divided by the square of the ratio to five.
double MoistRoadShare(double moisture_percent);

/// Total wind erosion per square metre of loose soil after a disturbance, 13.2.5 equation 3: 58 (u*
/// - u*t)^2 + 25 (u* - u*t) g/m^2.
double ErosionPotential_gpm2(double friction_velocity_mps, double threshold_mps);
/// Eroded mass by size.
DustMass WindErosion_kg(double potential_kg);

/// Friction velocity of a wind 10 m above the ground, over a roughness of 5 mm (13.2.5): the wind
/// times 0.4 / ln(10 m / 5 mm).
double FrictionVelocity_mps(double wind_10m_mps);

/// Mass of water over mass of dry soil at a degree of saturation S: S (1 / rho - 1 / rho_s) rho_w
/// with grains of 2650 kg/m^3.
double WaterByMass_percent(double saturation, double bank_density_kgpm3);

/// Settling speed of a sphere in still air, by Stokes: rho d^2 g / (18 mu), mu = 18.1 uPa s.
double StokesSpeed_mps(double diameter_m, double density_kgpm3);

}  // namespace tera
