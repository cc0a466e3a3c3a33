#include "soil/track/terramechanics.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "soil/columns/soil_type.h"

namespace tera {
namespace {

constexpr double kPoisson = 0.3;
constexpr double kLongestPatch = 4;  ///< width of a patch counts up to this many lengths
constexpr double kShape = 0.88;  ///< rigid square plate: Das, Principles of Foundation Engineering

constexpr double kShearDampingRatio = 0.7;  ///< share of critical; effective only near rest
constexpr double kRestSpeed_mps = 0.02;     ///< slip speed at which shear damping falls to half
constexpr double kLargestShear = 8.0;       ///< limit of |j| in units of K, nearly full strength
constexpr double kLeastShear_m = 1e-15;     ///< a smaller slip has no direction

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

double HeaveReach_m(const SoilType& soil, double width_m) {
  return width_m * std::sqrt(LocalShear(soil.shear_friction_rad).n_q);
}

PushedFace::PushedFace(const SoilType& soil)
    : cot_(std::tan(45 * kDeg + 0.5 * soil.shear_friction_rad)),
      tan_phi_(std::tan(soil.shear_friction_rad)),
      cohesion_pa_(soil.shear_cohesion_pa),
      weight_npm3_(soil.bank_density_kgpm3 * kStandardGravity_mps2) {}

double PushedFace::Resistance_npm(double depth_m) const {
  if (depth_m <= 0) return 0;
  const double heaped = 1 + cot_ * tan_phi_;
  return 2 * cot_ *
         (cohesion_pa_ * depth_m + 0.5 * weight_npm3_ * depth_m * depth_m * cot_ * heaped);
}

double PushedFace::Depth_m(double depth_m, double loose_m) const {
  const double heaped = 0.5 * cot_ * tan_phi_;
  return std::max(depth_m - loose_m, depth_m / (1 + heaped));
}

Vec2 Mobilised(const SoilType& soil, const Vec2& j_m) {
  const double size = j_m.norm();
  if (size < 1e-12) return Vec2::Zero();
  return j_m * (ShearMobilisation(soil, size) / size);
}

/// Splits the stress into parts along and across the slip. The part along the slip grows by
/// Janosi's law. If it points against the slip, it first unloads at the initial stiffness. The part
/// across decays.
void ShearFurther(const SoilType& soil, const Vec2& slip_m, Vec2* j_m) {
  const double size_m = slip_m.norm();
  const double limit_m = kLargestShear * soil.shear_modulus_m;
  if (size_m < kLeastShear_m) {
    if (j_m->norm() > limit_m) *j_m *= limit_m / j_m->norm();
    return;
  }
  const double path = size_m / soil.shear_modulus_m;
  const Vec2 direction = slip_m / size_m;
  const Vec2 stress = Mobilised(soil, *j_m);
  double along = stress.dot(direction);
  const Vec2 across = (stress - along * direction) * std::exp(-stress.squaredNorm() * path);
  const double unloading = std::min(path, std::max(0.0, -along));
  along += unloading;
  along = 1 - (1 - along) * std::exp(-(path - unloading));
  const Vec2 after = along * direction + across;
  const double size = after.norm();
  if (size <= 0) {
    j_m->setZero();
    return;
  }
  const double most = ShearMobilisation(soil, limit_m);
  *j_m = -soil.shear_modulus_m * std::log1p(-std::min(size, most)) / size * after;
}

Vec2 ShearForce_n(const ShearStrength& strength, const Vec2& mobilised, double j_m,
                  const Vec2& slip_mps) {
  const double most_n = strength.force_n();
  const double mass_kg = strength.normal_n / kStandardGravity_mps2;
  const double speed = slip_mps.norm() / kRestSpeed_mps;
  const double k_m = strength.soil.shear_modulus_m;
  const double stiffness_npm = most_n / k_m * std::exp(-j_m / k_m);
  const double damping =
      2 * kShearDampingRatio * std::sqrt(stiffness_npm * mass_kg) / (1 + speed * speed);
  Vec2 force_n = -most_n * mobilised - damping * slip_mps;
  if (force_n.norm() > most_n) force_n *= most_n / force_n.norm();
  return force_n;
}

}  // namespace tera
