#include "soil/terramechanics.h"

#include <cmath>

namespace tera {
namespace {

constexpr double kPoisson = 0.3;
constexpr double kShape = 0.88;  ///< rigid square plate, Das, Principles of Foundation Engineering

double Modulus_npm_n2(const SoilType& soil, double width_m) {
  return soil.k_c_npm_n1 / width_m + soil.k_phi_npm_n2;
}

}  // namespace

double BekkerPressure_pa(const SoilType& soil, double width_m, double z_m) {
  if (z_m <= 0) return 0;
  return Modulus_npm_n2(soil, width_m) * std::pow(z_m, soil.sinkage_exponent);
}

double BekkerSinkage_m(const SoilType& soil, double width_m, double pressure_pa) {
  if (pressure_pa <= 0) return 0;
  return std::pow(pressure_pa / Modulus_npm_n2(soil, width_m), 1 / soil.sinkage_exponent);
}

double BekkerWork_jpm2(const SoilType& soil, double width_m, double z_m) {
  if (z_m <= 0) return 0;
  const double n = soil.sinkage_exponent;
  return Modulus_npm_n2(soil, width_m) * std::pow(z_m, n + 1) / (n + 1);
}

double Rebound_papm(const SoilType& soil, double width_m) {
  return soil.young_modulus_pa / ((1 - kPoisson * kPoisson) * kShape * width_m);
}

double ShearMobilisation(const SoilType& soil, double j_m) {
  return -std::expm1(-j_m / soil.shear_modulus_m);
}

double TrackThrust_n(const SoilType& soil, double width_m, double length_m, double load_n,
                     double slip) {
  const double strength_n =
      width_m * length_m * soil.cohesion_pa + load_n * std::tan(soil.friction_angle_rad);
  const double ratio = slip * length_m / soil.shear_modulus_m;
  return strength_n * (1 + std::expm1(-ratio) / ratio);
}

double CompactionResistance_n(const SoilType& soil, double width_m, double z_m) {
  return width_m * BekkerWork_jpm2(soil, width_m, z_m);
}

}  // namespace tera
