#include "sim/scenario/task_of_machine.h"

#include <fmt/format.h>

#include <cmath>

#include "core/units.h"

namespace tera {
namespace {

constexpr double kMostOffLine_m = 0.3, kMostTurned_rad = 15 * kDeg;
constexpr double kLeastWindow = 1.5;  ///< smallest range of digging radii, in bucket lengths
constexpr double kDepthStep_m = 0.05;
constexpr double kWidthRounding_m = 1e-6;

/// Height of the slewing frame above the ground under it.
double SlewHeight_m(const MachinePlacement& placement, int slew, const TerrainSurface& ground) {
  const Joint& joint = placement.model.joints[slew];
  const std::vector<Pose> X_WB =
      ForwardKinematics(placement.model, placement.X_WB, placement.q_rad);
  const Vec3 p_W_m = (X_WB[joint.parent] * joint.X_PJ).translation();
  return p_W_m.z() - ground.HeightAt(p_W_m.x(), p_W_m.y());
}

/// Whether the machine stands on the line and faces the trench's first end.
bool StandsOnLine(const MachinePlacement& placement, const TrenchWork& trench) {
  const Vec2 xy_m = placement.X_WB.translation().head<2>();
  const Vec2 ahead = placement.X_WB.linear().col(0).head<2>().normalized();
  return std::abs(trench.OffsetOf(xy_m)) <= kMostOffLine_m &&
         trench.StationOf(xy_m) > 0.5 * trench.plan().near_m &&
         -ahead.dot(trench.line().Along()) >= std::cos(kMostTurned_rad);
}

}  // namespace

void GiveTask(const std::optional<ConfigMap>& task_config, const ConfigMap& machine_config,
              const std::optional<Task>& task, const TerrainSurface& ground,
              const MachinePlacement& placement, OperatorPlan* driver) {
  DigPlan* plan = std::get_if<DigPlan>(driver);
  if (plan == nullptr || !plan->to_design) return;
  const ConfigMap config = machine_config.Map("operator");
  if (!task_config) {
    config.Fault("type", {FaultKind::kMissing,
                          "digs to a design, but the scenario has no task; need a task with a "
                          "trench, or type: dig_cycle"});
    return;
  }
  if (!task) return;  // its faults are reported
  if (!task->trench) {
    config.Fault("type", {FaultKind::kUnsupported,
                          "digs only trenches; need a task with a trench, or another operator"});
    return;
  }
  const MachineModel& model = placement.model;
  const Shovel& bucket = model.ground_tools.shovels[plan->shovel];
  const ConfigMap shape = task_config->Map("trench");
  if (task->trench->width_m < bucket.width_m - kWidthRounding_m) {
    shape.Fault("width_m", {FaultKind::kOutOfRange,
                            fmt::format("{:g} m is narrower than the bucket of '{}'; need {:g} m "
                                        "or more, or another machine",
                                        task->trench->width_m, placement.name, bucket.width_m)});
    return;
  }
  const PlanarArm arm(model, plan->joints, plan->tip_frame);
  const double slew_m = SlewHeight_m(placement, plan->joints.slew, ground);
  const auto radii = [&](double depth_m) -> std::optional<WorkingRadii> {
    const auto found = RadiiOfWork(model, arm, plan->joints, -slew_m, -slew_m - depth_m);
    const bool wide = found && found->far_m - found->near_m >= kLeastWindow * arm.bucket_length_m();
    return wide ? found : std::nullopt;
  };
  const std::optional<WorkingRadii> window = radii(task->trench->depth_m);
  if (!window) {
    double deepest_m = 0;
    while (radii(deepest_m + kDepthStep_m)) deepest_m += kDepthStep_m;
    shape.Fault("depth_m",
                {FaultKind::kOutOfRange,
                 fmt::format("{:g} m is deeper than '{}' digs a level floor; need at most {:.2f} "
                             "m, or a larger machine",
                             task->trench->depth_m, placement.name, deepest_m)});
    return;
  }
  TrenchPlan trench{.task = *task,
                    .tracks = plan->tracks,
                    .bucket_m = bucket.width_m,
                    .near_m = window->near_m,
                    .far_m = window->far_m};
  if (!StandsOnLine(placement, TrenchWork(trench))) {
    machine_config.Fault("start",
                         fmt::format("does not stand on the trench's line; need a place within "
                                     "{:g} m of it, from {:.1f} m on from its first end, facing "
                                     "that end",
                                     kMostOffLine_m, 0.5 * trench.near_m));
    return;
  }
  plan->trench = trench;
}

}  // namespace tera
