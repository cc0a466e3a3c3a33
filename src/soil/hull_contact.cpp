#include "soil/hull_contact.h"

#include <algorithm>
#include <cmath>

namespace tera {
namespace {

/// A rigid corner 0.15 m across on soil of 5 MPa, E d / (0.88 (1 - nu^2)): 3.5 t on four points
/// sink 9 mm.
constexpr double kStiffness_npm = 1e6;
constexpr double kDamping_nspm = 1.8e4;   ///< about 0.3 of critical for a quarter of that machine
constexpr double kFriction = 0.5;         ///< steel on soil
constexpr double kCreepSpeed_mps = 0.05;  ///< friction is proportional to speed below it

}  // namespace

Wrench HullContact::Act(const BodyState& body, double dt_s, const Columns& ground) {
  Wrench wrench;
  const Vec3 p_W = body.X_WB * point_.p_B_m;
  const double z_m = ground.HeightAt(p_W.x(), p_W.y());
  if (p_W.z() >= z_m) {
    pressed_m_ = 0;
    return wrench;
  }
  const double h = ground.cell_m();
  const Vec3 n_W =
      Vec3(ground.HeightAt(p_W.x() - h, p_W.y()) - ground.HeightAt(p_W.x() + h, p_W.y()),
           ground.HeightAt(p_W.x(), p_W.y() - h) - ground.HeightAt(p_W.x(), p_W.y() + h), 2 * h)
          .normalized();
  const Vec3 v_W = PointVelocity(body, point_.p_B_m);
  const double depth_m = (z_m - p_W.z()) * n_W.z();
  const double parting_mps = v_W.dot(n_W);
  pressed_m_ = std::clamp(pressed_m_ - parting_mps * dt_s, 0.0, depth_m);
  if (pressed_m_ == 0) return wrench;
  const double normal_n = std::max(0.0, kStiffness_npm * pressed_m_ - kDamping_nspm * parting_mps);
  const Vec3 slide_W = v_W - v_W.dot(n_W) * n_W;
  const Vec3 friction_n =
      -kFriction * normal_n * slide_W / std::max(slide_W.norm(), kCreepSpeed_mps);
  wrench.AddForceAt(normal_n * n_W + friction_n, p_W, body.X_WB.translation());
  return wrench;
}

}  // namespace tera
