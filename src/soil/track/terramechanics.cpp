#include "soil/track/terramechanics.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "soil/columns/soil_type.h"

namespace tera {
namespace {

constexpr double kPoisson = 0.3;
constexpr double kLongestPatch = 4;  ///< times its length counts of a patch's width
constexpr double kShape = 0.88;  ///< rigid square plate, Das, Principles of Foundation Engineering

double Modulus_npm_n2(const SoilType& soil, double width_m) {
  return soil.k_c_npm_n1 / width_m + soil.k_phi_npm_n2;
}

}  // namespace

double BekkerPressure_pa(const SoilType& soil, double width_m, double z_m) {
  if (z_m <= 0) return 0;
  return Modulus_npm_n2(soil, width_m) * std::pow(z_m, soil.sinkage_exponent);
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

double PlateWidth_m(const ContactPatch& patch) {
  return std::min(patch.width_m, kLongestPatch * patch.length_m);
}

double PressureShare(const ContactPatch& patch, double along_m) {
  if (patch.wheel_pitch_m <= 0) return 1;
  return 1 + std::cos(2 * kPi * (patch.past_wheel_m + along_m) / patch.wheel_pitch_m);
}

double BulldozingResistance_n(const SoilType& soil, double width_m, double z_m) {
  if (z_m <= 0) return 0;
  constexpr double kCohesionShare = 0.67;
  const BearingFactors n = LocalShear(soil.shear_friction_rad);
  const double t = std::tan(n.friction_angle_rad);
  const double cos_squared = 1 / (1 + t * t);
  const double k_pc = (n.n_c - t) * cos_squared;
  const double k_pgamma = (2 * n.n_gamma / t + 1) * cos_squared;
  const double weight_npm3 = soil.bank_density_kgpm3 * kStandardGravity_mps2;
  return width_m * (kCohesionShare * soil.shear_cohesion_pa * z_m * k_pc +
                    0.5 * weight_npm3 * z_m * z_m * k_pgamma);
}

double FaceResistance_npm(const SoilType& soil, double depth_m) {
  if (depth_m <= 0) return 0;
  const double cot = std::tan(45 * kDeg + 0.5 * soil.shear_friction_rad);  // of X, tan of X + phi
  const double heaped = 1 + cot * std::tan(soil.shear_friction_rad);
  const double weight_npm3 = soil.bank_density_kgpm3 * kStandardGravity_mps2;
  return 2 * cot *
         (soil.shear_cohesion_pa * depth_m + 0.5 * weight_npm3 * depth_m * depth_m * cot * heaped);
}

}  // namespace tera
