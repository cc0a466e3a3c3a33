#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/config/config.h"
#include "soil/soil.h"

namespace tera {

/// Reads one soil; config/soils/dirt.yaml explains the keys. Faults go to `config`.
SoilType ReadSoilType(const ConfigMap& config);

/// File of the shipped soil `name`; empty if there is none.
std::optional<std::filesystem::path> ShippedSoilFile(const std::string& name);

/// Names of all shipped soils, sorted and separated by commas.
std::string ShippedSoilNames();

/// The soil with strength and stiffness scaled by the footing factors of a machine.
SoilType ScaledByFooting(const SoilType& soil, const Footing& footing);

/// Density of freshly dug or dumped soil.
inline double LooseDensity_kgpm3(const SoilType& soil) {
  return soil.bank_density_kgpm3 / soil.swell;
}

/// Density of undisturbed soil after a pressure. The void ratio becomes e - C_c log10(1 + p / p_0).
/// p_0 = 10 kPa is the past load on the upper half metre of a site (an estimate). The density is at
/// most the maximum of the soil.
/// Source  Terzaghi 1943; Das, Principles of Geotechnical Engineering, ch. 11.
double PressedDensity_kgpm3(const SoilType& soil, double pressure_pa);

/// Stiffness factor of soil: its bearing modulus divided by that of undisturbed soil.
/// `density_share` is its density divided by that of undisturbed soil. The factor is density_share
/// to the power 12.4, at most 1.
/// Source  Fit to loose and dense sand. Moduli of subgrade reaction, 13 and 160 MN/m^3: Terzaghi,
///         Geotechnique 5, 1955. Densities, 1.43 and 1.75 t/m^3: Terzaghi and Peck 1967, table 6.3.
double FirmnessAt(double density_share);

/// Bearing factors of a strip footing: Reissner's N_q, Prandtl's N_c and Vesic's N_gamma.
/// Source  Das, Principles of Foundation Engineering, ch. 3.
struct BearingFactors {
  double n_c, n_q, n_gamma;
  double friction_angle_rad;  ///< the angle that the factors belong to
};
/// Factors for local shear, in soil that compresses before it fails. They use two thirds of tan
/// phi.
/// Source  Terzaghi 1943.
BearingFactors LocalShear(double friction_angle_rad);

/// Terzaghi's bearing pressure under a strip of `width_m` at `depth_m`, for local shear: two thirds
/// of cohesion and of tan phi. It is c N_c + rho g depth N_q + rho g width N_gamma / 2, with the
/// factors of BearingFactors.
/// Source  Terzaghi 1943; Das, Principles of Foundation Engineering, ch. 3.
double BearingPressure_pa(const SoilType& soil, double width_m, double depth_m);

/// Greatest bearing pressure under running gear of width b. It limits Bekker's pressure-sinkage
/// curve.
struct BearingLimit {
  double at_surface_pa, per_depth_papm;

  double At_pa(double depth_m) const { return at_surface_pa + per_depth_papm * depth_m; }
};

/// Bearing capacity under running gear.
///
/// Model   General shear: c N_c + rho g (depth N_q + b N_gamma / 2), for the stronger of the two
///         strength pairs of the soil. A pass is too short for fine wet soil to drain, so its pore
///         water carries part of the load. Friction then fades with the degree of saturation, from
///         full at 0.85 to none at 1. The time factor is T = K_s E t / (gamma_w b^2) with t = 1 s.
///         The fading is complete for T < 0.1 and absent for T > 0.4. Without friction the limit is
///         Prandtl's (2 + pi) c. Soil that holds no water (pavement) has no limit.
/// Source  Prandtl 1920, Reissner 1924; T: Vermeer and Meier 1998 (PLAXIS, Reference Manual); air:
///         Fredlund and Rahardjo 1993, Soil Mechanics for Unsaturated Soils, ch. 2.
BearingLimit LimitUnderGear(const SoilType& soil, double width_m);

}  // namespace tera
