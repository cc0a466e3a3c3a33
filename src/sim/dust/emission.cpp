#include "sim/dust/emission.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"

namespace tera {
namespace {

constexpr double kGrainDensity_kgpm3 = 2650;
constexpr double kWaterDensity_kgpm3 = 1000;
constexpr double kAirViscosity_pas = 1.81e-5;  // at 15 C
constexpr double kKarman = 0.4;

/// Mass in each size class from the masses below 2.5, 10 and 30 um.
DustMass BySize(double pm2_5, double pm10, double pm30) {
  return {pm2_5, pm10 - pm2_5, pm30 - pm10};
}

}  // namespace

DustMass DropEmission_kgpt(double wind_mps, double moisture_percent) {
  constexpr double kLeastWind_mps = 0.6, kMostWind_mps = 6.7, kLeastMoisture_percent = 0.25;
  const double wind = std::clamp(wind_mps, kLeastWind_mps, kMostWind_mps);
  const double moisture = std::max(moisture_percent, kLeastMoisture_percent);
  const double all = 0.0016 * std::pow(wind / 2.2, 1.3) / std::pow(moisture / 2, 1.4);
  return BySize(0.053 * all, 0.35 * all, 0.74 * all);
}

double DropHeightFactor(double fall_m) {
  constexpr double kUsual_m = 1.5, kExponent = 0.7;
  return std::pow(std::max(fall_m, 0.0) / kUsual_m, kExponent);
}

DustMass RoadEmission_kgpkm(double silt_percent, double vehicle_kg) {
  constexpr double kKgPerShortTon = 907.18474;
  constexpr double kKgPerKm = 0.2819;  // one pound per mile travelled (AP-42)
  const double silt = silt_percent / 12, weight = vehicle_kg / kKgPerShortTon / 3;
  const double heavy = std::pow(weight, 0.45) * kKgPerKm;
  return BySize(0.15 * std::pow(silt, 0.9) * heavy, 1.5 * std::pow(silt, 0.9) * heavy,
                4.9 * std::pow(silt, 0.7) * heavy);
}

double MoistRoadShare(double moisture_percent) {
  constexpr double kDry_percent = 0.5;  // AP-42's default for dry surfaces, 13.2.2
  const double ratio = moisture_percent / kDry_percent;
  if (ratio <= 1) return 1;
  if (ratio <= 2) return 1 - 0.75 * (ratio - 1);
  if (ratio <= 5) return 0.25 - 0.20 * (ratio - 2) / 3;
  return 0.05 * 25 / (ratio * ratio);
}

double ErosionPotential_gpm2(double friction_velocity_mps, double threshold_mps) {
  const double above = friction_velocity_mps - threshold_mps;
  return above > 0 ? 58 * above * above + 25 * above : 0;
}

DustMass WindErosion_kg(double potential_kg) {
  return BySize(0.075 * potential_kg, 0.5 * potential_kg, potential_kg);
}

double FrictionVelocity_mps(double wind_10m_mps) {
  constexpr double kHeight_m = 10, kRoughness_m = 0.005;
  return kKarman * wind_10m_mps / std::log(kHeight_m / kRoughness_m);
}

double WaterByMass_percent(double saturation, double bank_density_kgpm3) {
  const double pores_m3pkg = 1 / bank_density_kgpm3 - 1 / kGrainDensity_kgpm3;
  return 100 * saturation * std::max(pores_m3pkg, 0.0) * kWaterDensity_kgpm3;
}

double StokesSpeed_mps(double diameter_m, double density_kgpm3) {
  return density_kgpm3 * diameter_m * diameter_m * kStandardGravity_mps2 / (18 * kAirViscosity_pas);
}

}  // namespace tera
