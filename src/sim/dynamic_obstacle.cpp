#include "sim/dynamic_obstacle.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"

namespace tera {
namespace {

/// Largest distance between neighbouring contact points on an edge.
constexpr double kPointSpacing_m = 0.5;
constexpr double kCorners = 8;
/// Stiffness and damping of a corner, relative to those of a machine's structure of equal mass.
/// Explicit damping of a plate's corners is stable up to a factor of 3.2 at 100 steps per second.
constexpr double kFirmness = 3;

/// Inertia tensor of uniform boxes about their common centre, in the axes of B.
Mat3 InertiaOf(const std::vector<CollisionBox>& boxes, double mass_kg) {
  double volume_m3 = 0;
  Vec3 first_m4 = Vec3::Zero();
  Mat3 second_m5 = Mat3::Zero();  // integral of r r^T
  for (const CollisionBox& box : boxes) {
    const double part_m3 = box.size_m.prod();
    const Vec3& r_m = box.X_BG.translation();
    const Mat3& R_BG = box.X_BG.linear();
    const Mat3 about_centre_m2 = box.size_m.cwiseAbs2().asDiagonal() * Mat3::Identity() / 12.0;
    volume_m3 += part_m3;
    first_m4 += part_m3 * r_m;
    second_m5 += part_m3 * (R_BG * about_centre_m2 * R_BG.transpose() + r_m * r_m.transpose());
  }
  const Vec3 centre_m = first_m4 / volume_m3;
  const Mat3 second_m2 = second_m5 / volume_m3 - centre_m * centre_m.transpose();
  return mass_kg * (second_m2.trace() * Mat3::Identity() - second_m2);
}

/// Appends the points of one edge of a box, without its ends.
void AppendEdge(const CollisionBox& box, const Vec3& from_m, const Vec3& to_m,
                std::vector<GroundTools::HullPoint>* points) {
  const int parts =
      std::max(1, static_cast<int>(std::ceil((to_m - from_m).norm() / kPointSpacing_m)));
  for (int k = 1; k < parts; ++k) {
    const Vec3 p_G_m = from_m + (to_m - from_m) * (static_cast<double>(k) / parts);
    points->push_back({0, box.X_BG * p_G_m});
  }
}

/// Corners of a box, and points along its twelve edges.
void AppendPoints(const CollisionBox& box, std::vector<GroundTools::HullPoint>* points) {
  const Vec3 half_m = 0.5 * box.size_m;
  for (int corner = 0; corner < 8; ++corner) {
    const auto at = [&](int bits) {
      return Vec3((bits & 1 ? 1 : -1) * half_m.x(), (bits & 2 ? 1 : -1) * half_m.y(),
                  (bits & 4 ? 1 : -1) * half_m.z());
    };
    points->push_back({0, box.X_BG * at(corner)});
    for (const int axis : {1, 2, 4}) {
      if ((corner & axis) == 0) AppendEdge(box, at(corner), at(corner | axis), points);
    }
  }
}

}  // namespace

MachinePlacement PlacementOf(const ScenarioObstacle& obstacle, const Pose& X_WB) {
  TERA_CHECK(obstacle.dynamic.has_value(), obstacle.name);
  Link link;
  link.name = "body";
  link.label = obstacle.label;
  link.mass_kg = obstacle.dynamic->mass_kg;
  link.com_B_m = obstacle.dynamic->com_B_m;
  link.inertia_B_kgm2 = InertiaOf(obstacle.collision, link.mass_kg);
  link.collision = obstacle.collision;
  MachinePlacement placement;
  placement.name = obstacle.name;
  placement.X_WB = X_WB;
  MachineModel& model = placement.model;
  model.kind = "obstacle";
  model.links.push_back(std::move(link));
  GroundTools& tools = model.ground_tools;
  for (const CollisionBox& box : obstacle.collision) AppendPoints(box, &tools.hull_points);
  // The points share the stiffness of eight corners.
  tools.mass_kg = kFirmness * obstacle.dynamic->mass_kg * kCorners /
                  static_cast<double>(tools.hull_points.size());
  return placement;
}

}  // namespace tera
