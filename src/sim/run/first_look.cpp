#include "sim/run/first_look.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "render/gl/rasterizer.h"
#include "sim/scene_assembly.h"
#include "sim/simulation.h"

namespace tera {
namespace {

constexpr double kField_rad = 45 * kDeg, kDown_rad = 32 * kDeg, kBearing_rad = 215 * kDeg;
constexpr double kLeast_m = 9, kMost_m = 35;  ///< radius of the visible ground

/// A circle of ground that the picture shows.
struct Sight {
  Vec3 middle_W_m = Vec3::Zero();
  double radius_m = kLeast_m;
};

Sight SightOf(const Scenario& scenario) {
  Sight sight;
  for (const ScenarioMachine& machine : scenario.machines) {
    sight.middle_W_m +=
        machine.placement.X_WB.translation() / static_cast<double>(scenario.machines.size());
  }
  std::vector<double> distances_m;
  const auto add = [&](const Vec2& p_m) {
    distances_m.push_back((p_m - sight.middle_W_m.head<2>()).norm());
  };
  for (const ScenarioMachine& m : scenario.machines) add(m.placement.X_WB.translation().head<2>());
  for (const ScenarioObstacle& obstacle : scenario.obstacles) add(obstacle.xy_W_m);
  // The view covers three quarters of the objects. A distant object thus does not make all others
  // small.
  std::sort(distances_m.begin(), distances_m.end());
  if (!distances_m.empty()) sight.radius_m = distances_m[distances_m.size() * 3 / 4];
  sight.radius_m = std::clamp(sight.radius_m + 2, kLeast_m, kMost_m);
  return sight;
}

Pose EyeOf(const Sight& sight, double distance_m) {
  const Vec3 from(std::cos(kDown_rad) * std::sin(kBearing_rad),
                  std::cos(kDown_rad) * std::cos(kBearing_rad), std::sin(kDown_rad));
  Mat3 R_WC;
  R_WC.col(2) = -from;
  R_WC.col(0) = R_WC.col(2).cross(Vec3::UnitZ()).normalized();
  R_WC.col(1) = R_WC.col(2).cross(R_WC.col(0));
  return MakePose(sight.middle_W_m + distance_m * from, R_WC);
}

}  // namespace

Image<std::uint8_t> FirstLook(const Scenario& scenario, int width_px, int height_px,
                              const EglOptions& egl) {
  Scenario unsettled = scenario;
  unsettled.settle_s = 0;
  const Simulation simulation(unsettled);
  const SceneAssembly assembly(unsettled);
  Rasterizer rasterizer(assembly.model(), egl);
  CameraIntrinsics camera;
  camera.width_px = width_px;
  camera.height_px = height_px;
  camera.fx_px = camera.fy_px = 0.5 * width_px / std::tan(0.5 * kField_rad);
  camera.cx_px = 0.5 * (width_px - 1);
  camera.cy_px = 0.5 * (height_px - 1);
  const Sight sight = SightOf(scenario);
  SceneState state;
  state.X_WB = assembly.BodyPoses(simulation.state());
  state.terrain = &simulation.ground();
  return rasterizer.Render(camera, EyeOf(sight, sight.radius_m / std::tan(0.5 * kField_rad)), state)
      .rgb;
}

}  // namespace tera
