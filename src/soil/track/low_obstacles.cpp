#include "soil/track/low_obstacles.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"

namespace tera {
namespace {

constexpr double kMostBeside = 2;  ///< in half heights: distance of the foot of the 45 deg slope

/// A box with the index and sign of its most vertical axis.
struct Standing {
  Standing(const Pose& X_WB, const RigidObstacle::Box& box)
      : X_WG(X_WB * box.X_BG), half_m(0.5 * box.size_m) {
    const Vec3 up_G = X_WG.linear().row(2);
    up_G.cwiseAbs().maxCoeff(&up);
    sign = up_G[up] > 0 ? 1 : -1;
  }

  /// Height of the upper face at (x, y), or of the slope beside it.
  std::optional<double> TopAt(double x_m, double y_m) const {
    const Vec3 foot_G = X_WG.inverse() * Vec3(x_m, y_m, 0);
    const Vec3 up_G = X_WG.linear().row(2);
    const double z_m = (sign * half_m[up] - foot_G[up]) / up_G[up];
    const Vec3 hit_G = foot_G + z_m * up_G;
    Vec3 out_G = (hit_G.cwiseAbs() - half_m).cwiseMax(0);
    out_G[up] = 0;
    const double out_m = out_G.norm();
    if (out_m > kMostBeside * half_m[up]) return std::nullopt;
    return z_m - out_m;
  }

  std::optional<GroundExit> ExitFrom(const Vec3& p_W_m) const {
    const Vec3 p_G = X_WG.inverse() * p_W_m;
    if (((p_G.cwiseAbs() - half_m).array() >= 0).any()) return std::nullopt;
    int axis = up;
    double depth_m = half_m[up] - sign * p_G[up], way = sign;
    for (int k = 0; k < 3; ++k) {
      const double to_side_m = half_m[k] - std::abs(p_G[k]);
      if (k == up || to_side_m >= depth_m) continue;
      axis = k;
      depth_m = to_side_m;
      way = p_G[k] > 0 ? 1 : -1;
    }
    return GroundExit{depth_m, way * X_WG.linear().col(axis)};
  }

  Pose X_WG;
  Vec3 half_m;
  int up = 2;
  double sign = 1;
};

Vec3 VelocityAt(const BodyState& body, const Vec3& p_W_m) {
  return PointVelocity(body, body.X_WB.inverse() * p_W_m);
}

}  // namespace

int LowObstacles::Add(const RigidObstacle& obstacle) {
  double reach_m = 0;
  for (const RigidObstacle::Box& box : obstacle.boxes) {
    const Vec3 half_m = 0.5 * box.size_m;
    reach_m = std::max(
        reach_m, box.X_BG.translation().norm() + half_m.norm() + kMostBeside * half_m.maxCoeff());
  }
  placed_.push_back({obstacle, reach_m, {}});
  lowest_rise_m_ = std::min(lowest_rise_m_, obstacle.rise_m);
  return static_cast<int>(placed_.size()) - 1;
}

void LowObstacles::Move(int handle, const BodyState& carrier) {
  placed_.at(handle).state = carrier;
}

std::optional<LowObstacles::Top> LowObstacles::HighestAt(double x_m, double y_m,
                                                         double climb_m) const {
  std::optional<Top> highest;
  for (const Placed& placed : placed_) {
    if (placed.obstacle.rise_m > climb_m) continue;
    const Vec2 from_it = Vec2(x_m, y_m) - placed.state.X_WB.translation().head<2>();
    if (from_it.squaredNorm() > placed.reach_m * placed.reach_m) continue;
    for (const RigidObstacle::Box& box : placed.obstacle.boxes) {
      const std::optional<double> z_m = Standing(placed.state.X_WB, box).TopAt(x_m, y_m);
      if (!z_m || (highest && *z_m <= highest->z_m)) continue;
      highest = Top{*z_m, VelocityAt(placed.state, Vec3(x_m, y_m, *z_m))};
    }
  }
  return highest;
}

std::optional<LowObstacles::Exit> LowObstacles::ExitFrom(const Vec3& p_W_m, double climb_m) const {
  std::optional<Exit> deepest;
  for (const Placed& placed : placed_) {
    if (placed.obstacle.rise_m > climb_m) continue;
    for (const RigidObstacle::Box& box : placed.obstacle.boxes) {
      const std::optional<GroundExit> way = Standing(placed.state.X_WB, box).ExitFrom(p_W_m);
      if (!way || (deepest && way->depth_m <= deepest->way.depth_m)) continue;
      deepest = Exit{*way, VelocityAt(placed.state, p_W_m)};
    }
  }
  return deepest;
}

}  // namespace tera
