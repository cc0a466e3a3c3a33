#include "sim/scenario/sling.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"

namespace tera {
namespace {

constexpr double kStretch = 0.01;      ///< strain of a rope that carries the whole load
constexpr double kDampingRatio = 0.1;  ///< for the load on one rope

}  // namespace

void Pull(const Sling& sling, double load_kg, const BodyState& link, const BodyState& obstacle,
          Wrench* on_link, Wrench* on_obstacle) {
  const double stiffness_npm = load_kg * kStandardGravity_mps2 / (kStretch * sling.length_m);
  const double damping_nspm = 2 * kDampingRatio * std::sqrt(stiffness_npm * load_kg);
  const Vec3 hook_W_m = link.X_WB * sling.hook_B_m;
  for (const Vec3& point_T_m : sling.points_T_m) {
    const Vec3 point_W_m = obstacle.X_WB * point_T_m;
    const Vec3 leg_W_m = hook_W_m - point_W_m;
    const double stretch_m = leg_W_m.norm() - sling.length_m;
    if (stretch_m <= 0) continue;
    const Vec3 along_W = leg_W_m.normalized();
    const Vec3 parting_W_mps =
        PointVelocity(link, sling.hook_B_m) - PointVelocity(obstacle, point_T_m);
    const double tension_n =
        std::max(0.0, stiffness_npm * stretch_m + damping_nspm * parting_W_mps.dot(along_W));
    on_obstacle->AddForceAt(tension_n * along_W, point_W_m, obstacle.X_WB.translation());
    on_link->AddForceAt(-tension_n * along_W, hook_W_m, link.X_WB.translation());
  }
}

}  // namespace tera
