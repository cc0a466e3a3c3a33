#include "soil/columns/soil_water.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/units.h"

namespace tera {
namespace {

constexpr double kWilting_pa = 1.5e6;
/// stress between grains near the surface, equal to kBorne_pa
constexpr double kOverburden_pa = 10e3;

double Effective(const SoilWater& water, double moisture) {
  return std::clamp((moisture - water.residual) / (1 - water.residual), 0.0, 1.0);
}

}  // namespace

double Porosity(double density_kgpm3, double moisture) {
  const double voids =
      (kGrains_kgpm3 - density_kgpm3) / std::max(1.0, density_kgpm3 - moisture * kWater_kgpm3);
  return voids > 0 ? voids / (1 + voids) : 0;
}

double Conductivity_mps(const SoilWater& water, double moisture) {
  if (!water.holds()) return 0;
  const double share = Effective(water, moisture), m = 1 - 1 / water.n;
  const double passes = 1 - std::pow(1 - std::pow(share, 1 / m), m);
  return water.conductivity_mps * std::sqrt(share) * passes * passes;
}

double MoistureAt(const SoilWater& water, double suction_m) {
  const double m = 1 - 1 / water.n;
  const double share = std::pow(1 + std::pow(water.alpha_1pm * suction_m, water.n), -m);
  return water.residual + (1 - water.residual) * share;
}

double SuctionStress_pa(const SoilWater& water, double moisture) {
  if (!water.holds()) return 0;
  // Drier soil keeps the suction stress of the wilting point.
  const double weight_npm3 = kWater_kgpm3 * kStandardGravity_mps2;
  const double wilting =
      std::pow(1 + std::pow(water.alpha_1pm * kWilting_pa / weight_npm3, water.n), 1 / water.n - 1);
  const double share = std::max(Effective(water, moisture), wilting);
  const double suction_m =
      std::pow(std::pow(share, water.n / (1 - water.n)) - 1, 1 / water.n) / water.alpha_1pm;
  return share * std::min(suction_m * weight_npm3, kWilting_pa);
}

SoilType AtMoisture(const SoilType& soil, double moisture) {
  SoilType wet = soil;
  wet.name = fmt::format("{}_s{:02.0f}", soil.name, 100 * moisture);
  wet.moisture = moisture;
  const double pores = Porosity(soil.bank_density_kgpm3, soil.moisture);
  wet.bank_density_kgpm3 += pores * (moisture - soil.moisture) * kWater_kgpm3;
  // Ratio of water mass to grain mass, and the bulk density of the soil with full pores.
  const double grains_kgpm3 = kGrains_kgpm3 * (1 - pores);
  const double was = pores * soil.moisture * kWater_kgpm3 / grains_kgpm3;
  const double is = pores * moisture * kWater_kgpm3 / grains_kgpm3;
  const double full_kgpm3 = (1 + is) / (1 / kGrains_kgpm3 + is / kWater_kgpm3);
  wet.max_density_kgpm3 = std::max(
      wet.bank_density_kgpm3, std::min(soil.max_density_kgpm3 * (1 + is) / (1 + was), full_kgpm3));
  const double before_pa = SuctionStress_pa(soil.water, soil.moisture);
  const double after_pa = SuctionStress_pa(soil.water, moisture);
  const auto cohesion_pa = [&](double was_pa, double friction_rad) {
    return std::max(0.0, was_pa + (after_pa - before_pa) * std::tan(friction_rad));
  };
  wet.cohesion_pa = cohesion_pa(soil.cohesion_pa, soil.friction_angle_rad);
  wet.shear_cohesion_pa = cohesion_pa(soil.shear_cohesion_pa, soil.shear_friction_rad);
  wet.adhesion_pa = std::min(soil.adhesion_pa, wet.cohesion_pa);
  const double stiffness = std::sqrt((kOverburden_pa + after_pa) / (kOverburden_pa + before_pa));
  wet.young_modulus_pa *= stiffness;
  wet.k_c_npm_n1 *= stiffness;
  wet.k_phi_npm_n2 *= stiffness;
  return wet;
}

}  // namespace tera
