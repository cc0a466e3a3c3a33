#include "soil/track/shear.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "soil/track/terramechanics.h"

namespace tera {
namespace {

constexpr double kShearDampingRatio = 0.7;  ///< of critical, only near rest
constexpr double kRestSpeed_mps = 0.02;     ///< slip at which shear damping has faded to a half
constexpr double kLargestShear = 8.0;       ///< |j| is kept below this many K: fully mobilised
constexpr double kLeastShear_m = 1e-15;     ///< less is no slip, in any direction

}  // namespace

Vec2 Mobilised(const SoilType& soil, const Vec2& j_m) {
  const double size = j_m.norm();
  if (size < 1e-12) return Vec2::Zero();
  return j_m * (ShearMobilisation(soil, size) / size);
}

/// The stress has a part along the slip, which loads further as Janosi says, or, pointing against
/// it, unloads at the initial stiffness; and a part across, which yields to the slip.
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

double ShearStrength::force_n() const {
  return soil.shear_cohesion_pa * area_m2 + normal_n * std::tan(soil.shear_friction_rad);
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
