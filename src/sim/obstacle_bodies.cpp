#include "sim/obstacle_bodies.h"

namespace tera {

void AppendObstaclePoses(const ScenarioObstacle& obstacle, const Pose& X_WB, TimeNs t_ns,
                         std::vector<Pose>* poses) {
  const double scale = obstacle.visual.scale, travel_m = TravelOf(obstacle, t_ns);
  const Pose X_WG = X_WB * MakePose(Vec3(0, 0, RiseOf(obstacle.gait, scale, travel_m)));
  poses->push_back(obstacle.gait.empty() ? X_WB : X_WG);
  const TippingBed& tipping = obstacle.tipping;
  const Pose X_BT = TippedBed(obstacle, t_ns);
  if (tipping.visual) poses->push_back(X_WB * X_BT);
  if (tipping.gate) {  // the gate hangs vertically
    poses->push_back(X_WB * MakePose(Vec3(X_BT * tipping.gate_B_m - tipping.gate_B_m)));
  }
  for (const ObstacleWheel& wheel : obstacle.wheels) {
    const double angle_rad = travel_m / (scale * wheel.radius_m);
    poses->push_back(X_WB * MakePose(scale * wheel.axle_B_m) *
                     Eigen::AngleAxisd(angle_rad, Vec3::UnitY()));
  }
  for (const Pose& X_GL : LimbPoses(obstacle.gait, scale, travel_m)) poses->push_back(X_WG * X_GL);
}

void GrowBoxByLimb(const ScenarioObstacle& obstacle, std::size_t limb, const Mesh& mesh,
                   SceneInstance* instance) {
  constexpr int kMoments = 32;  // tested moments of a stride
  const double scale = obstacle.visual.scale;
  for (int k = 0; k < kMoments; ++k) {
    const double travel_m = scale * obstacle.gait.stride_m * k / kMoments;
    const Pose X_BL = LimbPoses(obstacle.gait, scale, travel_m)[limb];
    for (const MeshPart& part : mesh.parts) {
      for (const Eigen::Vector3f& p : part.positions_m) {
        const Vec3 p_B_m = X_BL * (scale * p.cast<double>());
        instance->box_min_B_m = instance->box_min_B_m.cwiseMin(p_B_m);
        instance->box_max_B_m = instance->box_max_B_m.cwiseMax(p_B_m);
      }
    }
  }
}

}  // namespace tera
