#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/config/config.h"
#include "soil/soil.h"

namespace tera {

/// Reads the keys of one soil (see config/soils/dirt.yaml). Faults go to `config`.
SoilType ReadSoilType(const ConfigMap& config);

/// File of the soil that TERA ships under `name`, if there is one.
std::optional<std::filesystem::path> ShippedSoilFile(const std::string& name);

/// Names of all shipped soils, sorted, separated by commas.
std::string ShippedSoilNames();

/// The soil with its strength and stiffness scaled as a machine of that footing acts on it.
SoilType ScaledByFooting(const SoilType& soil, const Footing& footing);

/// Density of the soil right after it was dug or dumped.
inline double LooseDensity_kgpm3(const SoilType& soil) {
  return soil.bank_density_kgpm3 / soil.swell;
}

/// Density to which `pressure_pa` presses undisturbed soil together. Its void ratio is e - C_c
/// log10(1 + p / p_0). p_0 = 10 kPa is the past load on the upper half metre of a site (an
/// estimate). The density never exceeds the greatest. Source: Terzaghi 1943; Das, Principles of
/// Geotechnical Engineering, ch. 11.
double PressedDensity_kgpm3(const SoilType& soil, double pressure_pa);

/// Bearing modulus of soil of `density_share` of its undisturbed density over that which it has
/// there, at most 1: its 12.4th power. Terzaghi's moduli of subgrade reaction of loose and dense
/// sand (Geotechnique 5, 1955: 13 and 160 MN/m^3) over their densities (Terzaghi and Peck 1967,
/// table 6.3: 1.43 and 1.75 t/m^3).
double FirmnessAt(double density_share);

/// Bearing factors of a strip footing: Reissner's N_q, Prandtl's N_c and Vesic's N_gamma.
/// Source: Das, Principles of Foundation Engineering, ch. 3.
struct BearingFactors {
  double n_c, n_q, n_gamma;
  double friction_angle_rad;  ///< the one to which they belong
};
/// For local shear (soil that compresses before it fails): those of two thirds of tan phi.
/// Source: Terzaghi 1943.
BearingFactors LocalShear(double friction_angle_rad);

/// Terzaghi's bearing pressure of a strip `width_m` wide pressed in at `depth_m`, for local shear
/// (soil that compresses before it fails: two thirds of cohesion and tan phi):
/// c N_c + rho g depth N_q + rho g width N_gamma / 2, with Reissner's N_q, Prandtl's N_c and
/// Vesic's N_gamma. Source: Terzaghi 1943; Das, Principles of Foundation Engineering, ch. 3.
double BearingPressure_pa(const SoilType& soil, double width_m, double depth_m);

/// The most that soil bears under running gear of width b, whatever Bekker's fit says beyond it.
struct BearingLimit {
  double at_surface_pa, per_depth_papm;

  double At_pa(double depth_m) const { return at_surface_pa + per_depth_papm * depth_m; }
};

/// Model   general shear, c N_c + rho g (depth N_q + b N_gamma / 2), the greater one of the soil's
///         two strengths. A pass is too short for fine soil to drain, and water that fills its
///         pores then takes the load. Friction fades as the pores' air is cut off, from a degree of
///         saturation of 0.85 to none at 1. It fades wholly where T = K_s E t / (gamma_w b^2) <
///         0.1, and not where T > 0.4, t = 1 s. Without friction it is Prandtl's (2 + pi) c. Soil
///         that holds no water (pavement) has no limit.
/// Source  Prandtl 1920, Reissner 1924; T: Vermeer and Meier 1998 (PLAXIS, Reference Manual); air:
///         Fredlund and Rahardjo 1993, Soil Mechanics for Unsaturated Soils, ch. 2.
BearingLimit LimitUnderGear(const SoilType& soil, double width_m);

}  // namespace tera
