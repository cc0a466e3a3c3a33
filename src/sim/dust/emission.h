#pragma once

#include <array>

/// Dust emission by handling of soil, driving, and wind.
///
/// Source  U.S. EPA, AP-42, Compilation of Air Pollutant Emission Factors, fifth edition: section
///         13.2.4 (Aggregate handling and storage piles, 2006), 13.2.2 (Unpaved roads, 2006),
///         13.2.5 (Industrial wind erosion, 2006), 11.9 (Western surface coal mining, 1998).

namespace tera {

/// Dust mass by aerodynamic diameter, in kg or in kg per another unit: up to 2.5 um, 2.5 to 10 um,
/// 10 to 30 um.
constexpr int kDustSizes = 3;
using DustMass = std::array<double, kDustSizes>;

/// Emission per tonne of dropped soil, 13.2.4 equation 1: k 0.0016 (U / 2.2)^1.3 / (M / 2)^1.4
/// kg/t. Wind U and moisture M are clamped to the equation's range (0.6 to 6.7 m/s, 0.25 to 4.8 %).
/// Wetter soil is an exception: the equation is extrapolated.
DustMass DropEmission_kgpt(double wind_mps, double moisture_percent);

/// Correction for the height of the fall: (h / 1.5 m)^0.7, from the dragline in table 11.9-2.
/// DropEmission_kgpt rests on measured bucket loads and dumps, taken as falls of 1.5 m.
double DropHeightFactor(double fall_m);

/// Emission of a vehicle per kilometre of dry unpaved ground, 13.2.2 equation 1a: k (s / 12)^a (W /
/// 3)^b lb/mile, with the silt content s in percent and the weight W in short tons.
DustMass RoadEmission_kgpkm(double silt_percent, double vehicle_kg);

/// Share of the dry road emission that remains on moist ground, from figure 13.2.2-2. It depends on
/// the ratio of the moisture to 0.5 %, AP-42's default for dry surfaces: 1/4 at ratio 2, 1/20 at
/// ratio 5, linear in between; 1/20 (5 / ratio)^2 beyond.
double MoistRoadShare(double moisture_percent);

/// Total wind erosion per square metre of loose soil after a disturbance, 13.2.5 equation 3: 58 (u*
/// - u*t)^2 + 25 (u* - u*t) g/m^2.
double ErosionPotential_gpm2(double friction_velocity_mps, double threshold_mps);
/// Splits an eroded mass by particle size.
DustMass WindErosion_kg(double potential_kg);

/// Friction velocity of a wind 10 m above the ground: wind speed times 0.4 / ln(10 m / 5 mm), for a
/// roughness of 5 mm (13.2.5).
double FrictionVelocity_mps(double wind_10m_mps);

/// Mass of water per mass of dry soil at the degree of saturation S: S (1 / rho - 1 / rho_s) rho_w.
/// rho is the bank density; rho_s = 2650 kg/m^3 is that of the grains.
double WaterByMass_percent(double saturation, double bank_density_kgpm3);

/// Settling speed of a sphere in still air by Stokes: rho d^2 g / (18 mu), mu = 18.1 uPa s.
double StokesSpeed_mps(double diameter_m, double density_kgpm3);

}  // namespace tera
