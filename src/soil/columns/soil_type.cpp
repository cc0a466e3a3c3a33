#include "soil/columns/soil_type.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/units.h"
#include "soil/columns/soil_water.h"

namespace tera {
namespace fs = std::filesystem;
namespace {

constexpr double kSteepest_deg = 89.0;   ///< angles of a soil stay below vertical
constexpr double kBorne_pa = 10e3;       ///< past load on the undisturbed soil near the surface
constexpr double kFirmnessPower = 12.4;  ///< ln(160 / 13) / ln(1.75 / 1.43)
constexpr double kLocalShear = 2.0 / 3;  ///< Terzaghi's factor on cohesion and tan(phi)

constexpr double kAirCutOff = 0.85;  ///< degree of saturation above which pore air is occluded
constexpr double kPass_s = 1;        ///< time in which a machine travels its own length
constexpr double kUndrained = 0.1, kDrained = 0.4;  ///< limits of the time factor

/// Water retention by soil texture: means of soils in the United States.
/// Source  Carsel and Parrish 1988, Water Resources Research 24(5).
struct Texture {
  const char* name;
  double theta_r, theta_s, alpha_1pcm, n, conductivity_cmpd;
};
constexpr Texture kTextures[] = {
    {"sand", 0.045, 0.43, 0.145, 2.68, 712.8},
    {"loamy_sand", 0.057, 0.41, 0.124, 2.28, 350.2},
    {"sandy_loam", 0.065, 0.41, 0.075, 1.89, 106.1},
    {"loam", 0.078, 0.43, 0.036, 1.56, 24.96},
    {"silt", 0.034, 0.46, 0.016, 1.37, 6.0},
    {"silt_loam", 0.067, 0.45, 0.020, 1.41, 10.8},
    {"sandy_clay_loam", 0.100, 0.39, 0.059, 1.48, 31.44},
    {"clay_loam", 0.095, 0.41, 0.019, 1.31, 6.24},
    {"silty_clay_loam", 0.089, 0.43, 0.010, 1.23, 1.68},
    {"sandy_clay", 0.100, 0.38, 0.027, 1.23, 2.88},
    {"silty_clay", 0.070, 0.36, 0.005, 1.09, 0.48},
    {"clay", 0.068, 0.38, 0.008, 1.09, 4.8},
};

/// Reads `texture`. A soil with `none` neither takes in nor gives off water.
SoilWater ReadWater(const ConfigMap& config) {
  constexpr double kPerMetre = 100, kDay_s = 86400;
  const std::string name = config.Choice(
      "texture",
      {"none", "sand", "loamy_sand", "sandy_loam", "loam", "silt", "silt_loam", "sandy_clay_loam",
       "clay_loam", "silty_clay_loam", "sandy_clay", "silty_clay", "clay"},
      "none");
  for (const Texture& t : kTextures) {
    if (name != t.name) continue;
    return {t.theta_r / t.theta_s, t.alpha_1pcm * kPerMetre, t.n,
            t.conductivity_cmpd / kPerMetre / kDay_s};
  }
  return {};
}

BearingFactors GeneralShear(double tan_phi) {
  constexpr double kLeastTan = 1e-3;  // below it N_c is close to its limit, pi + 2
  const double t = std::max(tan_phi, kLeastTan);
  const double phi = std::atan(t);
  const double n_q = std::exp(kPi * t) * std::pow(std::tan(kPi / 4 + phi / 2), 2);
  return {
      .n_c = (n_q - 1) / t, .n_q = n_q, .n_gamma = 2 * (n_q + 1) * t, .friction_angle_rad = phi};
}

/// Share of the friction that is left under a load as short as one pass of running gear.
double FrictionOfAPass(const SoilType& soil, double width_m) {
  const double filled = std::clamp((soil.moisture - kAirCutOff) / (1 - kAirCutOff), 0.0, 1.0);
  const double weight_npm3 = kWater_kgpm3 * kStandardGravity_mps2;
  const double time = soil.water.conductivity_mps * soil.young_modulus_pa * kPass_s /
                      (weight_npm3 * width_m * width_m);
  return 1 - filled * std::clamp((kDrained - time) / (kDrained - kUndrained), 0.0, 1.0);
}

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
  const auto require_strength = [&config](const char* key, double friction_rad,
                                          double cohesion_pa) {
    if (friction_rad > 0 || cohesion_pa > 0) return;
    config.Fault(key, {FaultKind::kOutOfRange,
                       "0, beside a cohesion of 0, is soil without strength; need either above 0"});
  };
  require_strength("friction_angle_deg", soil.friction_angle_rad, soil.cohesion_pa);
  if (config.Has("shear_friction_deg") || config.Has("shear_cohesion_pa")) {
    require_strength("shear_friction_deg", soil.shear_friction_rad, soil.shear_cohesion_pa);
  }
  soil.shear_modulus_m = config.Number("shear_modulus_m", Between(1e-4, 0.5, "m"));
  soil.compression_index =
      config.Number("compression_index", Between(0, 1, "(void ratio)"), soil.compression_index);
  soil.moisture = config.Number("moisture", Between(0, 1, "(degree of saturation)"));
  soil.water = ReadWater(config);
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
  constexpr double kLeastVoids = 1e-3;  // guards against a soil described without voids
  if (!std::isfinite(pressure_pa)) return soil.max_density_kgpm3;
  const double bank_kgpm3 = soil.bank_density_kgpm3;
  const double water_kgpm3 = soil.moisture * kWater_kgpm3;
  const double voids = std::max(
      kLeastVoids, (kGrains_kgpm3 - bank_kgpm3) / std::max(kLeastVoids, bank_kgpm3 - water_kgpm3));
  const double lost =
      soil.compression_index * std::log10(1 + std::max(0.0, pressure_pa) / kBorne_pa);
  const double pressed_kgpm3 = bank_kgpm3 * (1 + voids) / (1 + std::max(0.0, voids - lost));
  return std::min(soil.max_density_kgpm3, pressed_kgpm3);
}

double FirmnessAt(double density_share) {
  return density_share < 1 ? std::pow(density_share, kFirmnessPower) : 1;
}

BearingFactors LocalShear(double friction_angle_rad) {
  return GeneralShear(kLocalShear * std::tan(friction_angle_rad));
}

double BearingPressure_pa(const SoilType& soil, double width_m, double depth_m) {
  const BearingFactors n = LocalShear(soil.friction_angle_rad);
  const double weight_npm3 = soil.bank_density_kgpm3 * kStandardGravity_mps2;
  return kLocalShear * soil.cohesion_pa * n.n_c +
         weight_npm3 * (depth_m * n.n_q + 0.5 * width_m * n.n_gamma);
}

BearingLimit LimitUnderGear(const SoilType& soil, double width_m) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  if (!soil.water.holds()) return {kNone, 0};
  const double weight_npm3 = soil.bank_density_kgpm3 * kStandardGravity_mps2;
  const double left = FrictionOfAPass(soil, width_m);
  const auto limit = [&](double friction_rad, double cohesion_pa) {
    const BearingFactors n = GeneralShear(left * std::tan(friction_rad));
    return BearingLimit{cohesion_pa * n.n_c + 0.5 * weight_npm3 * width_m * n.n_gamma,
                        weight_npm3 * n.n_q};
  };
  const BearingLimit internal = limit(soil.friction_angle_rad, soil.cohesion_pa);
  const BearingLimit shear = limit(soil.shear_friction_rad, soil.shear_cohesion_pa);
  return internal.at_surface_pa > shear.at_surface_pa ? internal : shear;
}

}  // namespace tera
