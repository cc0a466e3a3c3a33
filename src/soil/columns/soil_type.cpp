#include "soil/columns/soil_type.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/units.h"

namespace tera {
namespace fs = std::filesystem;
namespace {

constexpr double kSteepest_deg = 89.0;  ///< angles of a soil stay short of vertical
constexpr double kSolids_kgpm3 = 2650, kWater_kgpm3 = 1000;
constexpr double kBorne_pa = 10e3;       ///< pressure that undisturbed soil near the surface knows
constexpr double kFirmnessPower = 12.4;  ///< ln(160 / 13) / ln(1.75 / 1.43)
constexpr double kLocalShear = 2.0 / 3;  ///< Terzaghi's reduction of cohesion and tan(phi)

fs::path SoilFolder() { return DataRoot() / "config" / "soils"; }

}  // namespace

SoilType ReadSoilType(const ConfigMap& config) {
  const Range density = Between(500, 4000, "kg/m^3");
  const Range angle = Between(0, kSteepest_deg, "deg");
  SoilType soil;
  soil.name = config.Text("name");
  soil.bank_density_kgpm3 = config.Number("bank_density_kgpm3", density);
  soil.max_density_kgpm3 = config.Number("max_density_kgpm3", density);
  if (soil.max_density_kgpm3 < soil.bank_density_kgpm3) {
    config.Fault("max_density_kgpm3",
                 fmt::format("{} is less than bank_density_kgpm3 {}; a soil is densest when "
                             "compacted",
                             soil.max_density_kgpm3, soil.bank_density_kgpm3));
  }
  soil.swell = config.Number("swell", Between(1, 2, "(loose over bank volume)"));
  soil.friction_angle_rad = kDeg * config.Number("friction_angle_deg", angle);
  soil.cohesion_pa = config.Number("cohesion_pa", AtLeast(0, "Pa"));
  soil.soil_tool_friction_rad = kDeg * config.Number("soil_tool_friction_deg", angle);
  soil.adhesion_pa = config.Number("adhesion_pa", AtLeast(0, "Pa"));
  soil.repose_angle_rad = kDeg * config.Number("repose_angle_deg", Between(1, 80, "deg"));
  soil.fast_flow_friction =
      config.Number("fast_flow_friction", Between(0.1, 10, "(over that of slow flow)"), 1.0);
  soil.young_modulus_pa = config.Number("young_modulus_pa", Between(1e5, 1e9, "Pa"));
  soil.k_c_npm_n1 = config.Number("k_c_npm_n1", AtLeast(0, "N/m^(n+1)"));
  soil.k_phi_npm_n2 = config.Number("k_phi_npm_n2", Positive("N/m^(n+2)"));
  soil.sinkage_exponent = config.Number("sinkage_exponent", Between(0.1, 2, ""));
  soil.shear_friction_rad =
      kDeg * config.Number("shear_friction_deg", angle, soil.friction_angle_rad / kDeg);
  soil.shear_cohesion_pa = config.Number("shear_cohesion_pa", AtLeast(0, "Pa"), soil.cohesion_pa);
  soil.shear_modulus_m = config.Number("shear_modulus_m", Between(1e-4, 0.5, "m"));
  soil.compression_index =
      config.Number("compression_index", Between(0, 1, "(void ratio)"), soil.compression_index);
  soil.moisture = config.Number("moisture", Between(0, 1, "(degree of saturation)"));
  soil.albedo = config.Vector3("albedo", Between(0, 1, ""), soil.albedo);
  soil.grain_size_m = config.Number("grain_size_m", Between(1e-5, 1, "m"), soil.grain_size_m);
  return soil;
}

std::optional<fs::path> ShippedSoilFile(const std::string& name) {
  const fs::path file = SoilFolder() / (name + ".yaml");
  if (name.find('/') != std::string::npos || !fs::is_regular_file(file)) return std::nullopt;
  return file;
}

std::string ShippedSoilNames() {
  std::vector<std::string> names;
  if (fs::is_directory(SoilFolder())) {
    for (const auto& entry : fs::directory_iterator(SoilFolder())) {
      if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
    }
  }
  std::sort(names.begin(), names.end());
  return fmt::format("{}", fmt::join(names, ", "));
}

SoilType ScaledByFooting(const SoilType& soil, const Footing& footing) {
  SoilType scaled = soil;
  scaled.cohesion_pa *= footing.strength;
  scaled.adhesion_pa *= footing.strength;
  scaled.friction_angle_rad = std::atan(footing.strength * std::tan(soil.friction_angle_rad));
  scaled.shear_cohesion_pa *= footing.strength;
  scaled.shear_friction_rad = std::atan(footing.strength * std::tan(soil.shear_friction_rad));
  scaled.soil_tool_friction_rad =
      std::atan(footing.strength * std::tan(soil.soil_tool_friction_rad));
  scaled.young_modulus_pa *= footing.stiffness;
  scaled.k_c_npm_n1 *= footing.stiffness;
  scaled.k_phi_npm_n2 *= footing.stiffness;
  return scaled;
}

double PressedDensity_kgpm3(const SoilType& soil, double pressure_pa) {
  constexpr double kLeastVoids = 1e-3;  // a description may have none
  if (!std::isfinite(pressure_pa)) return soil.max_density_kgpm3;
  const double bank_kgpm3 = soil.bank_density_kgpm3;
  const double water_kgpm3 = soil.moisture * kWater_kgpm3;
  const double voids = std::max(
      kLeastVoids, (kSolids_kgpm3 - bank_kgpm3) / std::max(kLeastVoids, bank_kgpm3 - water_kgpm3));
  const double lost =
      soil.compression_index * std::log10(1 + std::max(0.0, pressure_pa) / kBorne_pa);
  const double pressed_kgpm3 = bank_kgpm3 * (1 + voids) / (1 + std::max(0.0, voids - lost));
  return std::min(soil.max_density_kgpm3, pressed_kgpm3);
}

double FirmnessAt(double density_share) {
  return density_share < 1 ? std::pow(density_share, kFirmnessPower) : 1;
}

BearingFactors LocalShear(double friction_angle_rad) {
  constexpr double kLeastTan = 1e-3;  // below it N_c has its limit pi + 2
  const double t = std::max(kLocalShear * std::tan(friction_angle_rad), kLeastTan);
  const double phi = std::atan(t);
  const double n_q = std::exp(kPi * t) * std::pow(std::tan(kPi / 4 + phi / 2), 2);
  return {
      .n_c = (n_q - 1) / t, .n_q = n_q, .n_gamma = 2 * (n_q + 1) * t, .friction_angle_rad = phi};
}

double BearingPressure_pa(const SoilType& soil, double width_m, double depth_m) {
  const BearingFactors n = LocalShear(soil.friction_angle_rad);
  const double weight_npm3 = soil.bank_density_kgpm3 * kStandardGravity_mps2;
  return kLocalShear * soil.cohesion_pa * n.n_c +
         weight_npm3 * (depth_m * n.n_q + 0.5 * width_m * n.n_gamma);
}

}  // namespace tera
