#include "soil/track/hull_contact.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/check.h"
#include "soil/columns/soil_type.h"
#include "soil/track/ground_exit.h"

namespace tera {
namespace {

/// Mass of the machine that has the three values below. Stiffness and damping scale with the mass,
/// the width of the corner with its cube root.
constexpr double kReferenceMass_kg = 3500;
/// Stiffness E d / (0.88 (1 - nu^2)) of a rigid corner with d = 0.15 m on soil of 5 MPa. On four
/// points the reference machine sinks 9 mm.
constexpr double kStiffness_npm = 1e6;
constexpr double kDamping_nspm = 1.8e4;  ///< about 0.3 of critical for a quarter of the machine
constexpr double kCorner_m = 0.15;       ///< width of the touching corner
constexpr double kFriction = 0.5;        ///< steel on soil

}  // namespace

HullContact::HullContact(const GroundTools::HullPoint& point, double mass_kg, double climb_m)
    : point_(point),
      climb_m_(climb_m),
      stiffness_npm_(kStiffness_npm / kReferenceMass_kg * mass_kg),
      damping_nspm_(kDamping_nspm / kReferenceMass_kg * mass_kg),
      corner_m_(kCorner_m * std::cbrt(mass_kg / kReferenceMass_kg)) {
  TERA_CHECK(mass_kg >= 0, mass_kg);
}

void HullContact::Release() {
  pressed_m_ = 0;
  sheared_W_m_.setZero();
}

/// Greatest force that the ground bears at a point `depth_m` deep in it.
double HullContact::Most_n(const Vec3& p_W, double depth_m, const Columns& ground) const {
  constexpr double kNoLimit_n = std::numeric_limits<double>::infinity();
  const ColumnId k = ground.IdAt(ground.NearestI(p_W.x()), ground.NearestJ(p_W.y()));
  if (k == Columns::kNone || !ground.skin(k).is_loose) return kNoLimit_n;
  const Column& column = ground.at(k);
  if (p_W.z() < column.top_m - column.loose_m()) return kNoLimit_n;
  SoilType soil = ground.soils()[ground.soil_at(k)];
  soil.cohesion_pa = 0;
  const double width_m = corner_m_ + 2 * depth_m;
  return width_m * width_m * BearingPressure_pa(soil, width_m, depth_m);
}

Wrench HullContact::Act(const BodyState& body, double dt_s, const Columns& ground,
                        const LowObstacles& obstacles) {
  Wrench wrench;
  const Vec3 p_W = body.X_WB * point_.p_B_m;
  std::optional<GroundExit> exit = FindGroundExit(ground, p_W);
  Vec3 v_W = PointVelocity(body, point_.p_B_m);
  const std::optional<LowObstacles::Exit> off = obstacles.ExitFrom(p_W, climb_m_);
  const bool on_obstacle = off && (!exit || off->way.depth_m > exit->depth_m);
  if (on_obstacle) {
    exit = off->way;
    v_W -= off->v_W_mps;
  }
  if (!exit) {
    Release();
    return wrench;
  }
  const Vec3& n_W = exit->direction_W;
  const double parting_mps = v_W.dot(n_W);
  pressed_m_ = std::clamp(pressed_m_ - parting_mps * dt_s, 0.0, exit->depth_m);
  if (pressed_m_ == 0) {
    Release();
    return wrench;
  }
  const double bears_n =
      on_obstacle ? std::numeric_limits<double>::infinity() : Most_n(p_W, exit->depth_m, ground);
  pressed_m_ = std::min(pressed_m_, bears_n / stiffness_npm_);
  const double normal_n =
      std::clamp(stiffness_npm_ * pressed_m_ - damping_nspm_ * parting_mps, 0.0, bears_n);

  const Vec3 slide_W_mps = v_W - parting_mps * n_W;
  sheared_W_m_ -= slide_W_mps * dt_s;
  sheared_W_m_ -= sheared_W_m_.dot(n_W) * n_W;  // the way out may have turned
  Vec3 friction_W_n = stiffness_npm_ * sheared_W_m_ - damping_nspm_ * slide_W_mps;
  const double most_n = kFriction * normal_n;
  if (friction_W_n.norm() > most_n) {
    const double share = most_n / friction_W_n.norm();
    friction_W_n *= share;
    sheared_W_m_ *= share;
  }
  wrench.AddForceAt(normal_n * n_W + friction_W_n, p_W, body.X_WB.translation());
  return wrench;
}

}  // namespace tera
