#include "serve/observation.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/error.h"
#include "physics/actuation/linkage.h"
#include "serve/geometry_messages.h"
#include "serve/session.h"

namespace tera {
namespace {

// Limits that reject mistyped sizes.
constexpr double kLargestPatch_m = 200.0;
constexpr int kMostPatchVertices = 1024;

/// Index of the item whose `name_of` equals `name`.
template <typename Items, typename NameOf>
std::size_t IndexOf(const Items& items, const NameOf& name_of, const std::string& name,
                    const std::string& what) {
  const auto found = std::find_if(items.begin(), items.end(),
                                  [&](const auto& item) { return name_of(item) == name; });
  if (found != items.end()) return static_cast<std::size_t>(found - items.begin());
  std::vector<std::string> names;
  for (const auto& item : items) names.push_back(name_of(item));
  throw InputError(
      "", {FaultKind::kNoSuchName,
           fmt::format("no {} named '{}'; need one of: {}", what, name,
                       names.empty() ? "none there" : fmt::format("{}", fmt::join(names, ", ")))});
}

PatchPlan PlanPatch(const v1::PatchSelection& patch, const Scenario& scenario) {
  PatchPlan plan;
  plan.machine = MachineIndex(scenario, patch.machine());
  if (!patch.shovel().empty()) {
    const auto& shovels = scenario.machines[plan.machine].placement.model.ground_tools.shovels;
    plan.shovel = static_cast<int>(IndexOf(
        shovels, [](const Shovel& shovel) { return shovel.name; }, patch.shovel(),
        fmt::format("shovel of machine '{}'", patch.machine())));
  }
  const double size_m = patch.size_m(), step_m = patch.resolution_m();
  if (!(size_m > 0 && size_m <= kLargestPatch_m)) {
    throw InputError("", {FaultKind::kOutOfRange,
                          fmt::format("terrain patch of {} m; need more than 0 and at most {} m",
                                      size_m, kLargestPatch_m)});
  }
  if (!(step_m > 0 && step_m <= size_m && size_m / step_m < kMostPatchVertices - 1)) {
    throw InputError(
        "", {FaultKind::kOutOfRange,
             fmt::format("terrain patch of {} m with a resolution of {} m; need at most {} "
                         "vertices along an edge, and at least 2",
                         size_m, step_m, kMostPatchVertices)});
  }
  const int intervals = static_cast<int>(std::lround(size_m / step_m));
  plan.n = intervals + 1;
  plan.resolution_m = size_m / intervals;
  return plan;
}

/// Upper bound of the size of one sample in a message.
double SampleBytes(const SensorDescription& sensor, const MachineModel& machine) {
  constexpr double kSmall_bytes = 200;  // time stamps and tags
  constexpr double kPoint_bytes = 3 * 4 + 4 + 4 + 2 + 1 + 2;
  const SensorKind& kind = KindOf(sensor);
  double bytes =
      kSmall_bytes + static_cast<double>(sizeof(double) * ColumnsOf(sensor, machine).size());
  if (const PictureContent* pictures = PicturesOf(sensor)) {
    double of_pixel = (pictures->rgb ? 3 : 0) + (pictures->depth ? 4 : 0);
    for (const LabelChannel& channel : kLabelChannels) {
      if (!pictures->labels[IndexOf(channel)]) continue;
      of_pixel += channel.components * static_cast<double>(ComponentBytes(channel));
    }
    bytes += of_pixel * pictures->intrinsics.width_px * pictures->intrinsics.height_px;
  }
  if (kind.scans) {
    const ScanContent scan = kind.scans(sensor);
    bytes += kPoint_bytes * scan.rings * scan.columns * scan.returns;
  }
  return bytes;
}

bool IsFrame(const SensorDescription& sensor) { return KindOf(sensor).form != ChannelForm::kRows; }

void CheckSize(double bytes, double duration_s) {
  if (bytes <= static_cast<double>(kLargestSamples_bytes)) return;
  throw InputError(
      "", {FaultKind::kOutOfRange,
           fmt::format(
               "samples of {} s and terrain may take {:.0f} MB, need at most {:.0f} MB; ask for "
               "the latest pictures and scans alone, fewer patches, or take shorter steps",
               duration_s, 1e-6 * bytes, 1e-6 * static_cast<double>(kLargestSamples_bytes))});
}

double PatchBytes(const PatchPlan& plan) {
  constexpr double kHead_bytes = 100;  // centre, heading, resolution and tags
  return kHead_bytes + sizeof(float) * static_cast<double>(plan.n) * static_cast<double>(plan.n);
}

void PutPatch(const PatchPlan& plan, const MachineModel& model, const MachineState& state,
              const TerrainSurface& ground, v1::TerrainPatch* patch) {
  Vec3 centre_W_m = state.links[0].X_WB.translation();
  if (plan.shovel >= 0) {
    const Shovel& shovel = model.ground_tools.shovels[plan.shovel];
    const Vec2 edge_m = shovel.profile_B_m.front();
    centre_W_m = state.links[shovel.link].X_WB * Vec3(edge_m.x(), 0, edge_m.y());
  }
  const Vec3 forward_W = state.links[0].X_WB.linear().col(0);
  const double yaw_rad = std::atan2(forward_W.y(), forward_W.x());
  const Eigen::Rotation2Dd turn(yaw_rad);
  const double half_m = 0.5 * (plan.n - 1) * plan.resolution_m;
  std::vector<float> height_m;
  height_m.reserve(static_cast<std::size_t>(plan.n) * plan.n);
  for (int j = 0; j < plan.n; ++j) {
    for (int i = 0; i < plan.n; ++i) {
      const Vec2 from_centre_m(i * plan.resolution_m - half_m, j * plan.resolution_m - half_m);
      const Vec2 p_W_m = centre_W_m.head<2>() + turn * from_centre_m;
      height_m.push_back(
          static_cast<float>(ground.HeightAt(p_W_m.x(), p_W_m.y()) - centre_W_m.z()));
    }
  }
  Put(centre_W_m, patch->mutable_centre_w_m());
  patch->set_yaw_rad(yaw_rad);
  patch->set_resolution_m(plan.resolution_m);
  patch->set_n(plan.n);
  patch->set_height_m(height_m.data(), height_m.size() * sizeof(float));
}

void PutCylinder(const MachineModel& model, const Cylinder& cylinder, const CylinderState& now,
                 const MachineState& state, v1::CylinderState* message) {
  message->set_length_m(now.length_m);
  message->set_stroke_m(now.stroke_m);
  message->set_rate_mps(now.rate_mps);
  message->set_force_n(now.force_n);
  message->set_head_pressure_pa(now.head_pressure_pa);
  message->set_rod_pressure_pa(now.rod_pressure_pa);
  const Pose X_BP =
      state.links[0].X_WB.inverse() * state.links[model.joints[cylinder.joint].parent].X_WB;
  const CylinderPins pins = PinsOf(model, cylinder, state.q_rad[cylinder.joint]);
  Put(Vec3(X_BP * pins.barrel_P_m), message->mutable_barrel_pin_b_m());
  Put(Vec3(X_BP * pins.rod_P_m), message->mutable_rod_pin_b_m());
}

void PutMachine(const MachinePlacement& machine, const MachineState& state,
                v1::MachineState* message) {
  const MachineModel& model = machine.model;
  const BodyState& root = state.links[0];
  message->set_name(machine.name);
  Put(root.X_WB, message->mutable_x_wb());
  Put(root.v_WB_mps, message->mutable_v_wb_mps());
  Put(Vec3(root.X_WB.linear().transpose() * root.w_WB_radps), message->mutable_w_wb_b_radps());
  message->mutable_joint_position()->Add(state.q_rad.begin(), state.q_rad.end());
  message->mutable_joint_rate()->Add(state.qd_radps.begin(), state.qd_radps.end());
  message->mutable_joint_effort()->Add(state.effort_nm.begin(), state.effort_nm.end());
  message->mutable_gear_angle_rad()->Add(state.gear_angle_rad.begin(), state.gear_angle_rad.end());
  message->mutable_gear_rate_radps()->Add(state.gear_rate_radps.begin(),
                                          state.gear_rate_radps.end());
  message->mutable_gear_torque_nm()->Add(state.gear_torque_nm.begin(), state.gear_torque_nm.end());
  message->mutable_gear_sinkage_m()->Add(state.gear_sinkage_m.begin(), state.gear_sinkage_m.end());
  message->mutable_gear_slip()->Add(state.gear_slip.begin(), state.gear_slip.end());
  message->mutable_lever()->Add(state.levers.begin(), state.levers.end());
  for (const SoilReaction::Load& load : state.shovel_load) {
    message->add_shovel_load_kg(load.mass_kg);
    message->add_shovel_load_m3(load.volume_m3);
  }
  for (const NamedFrame& frame : model.frames) {
    Put(Pose(root.X_WB.inverse() * state.links[frame.link].X_WB * frame.X_BF), message->add_x_bf());
  }
  for (std::size_t c = 0; c < model.cylinders.size(); ++c) {
    PutCylinder(model, model.cylinders[c], state.cylinders[c], state, message->add_cylinder());
  }
}

}  // namespace

std::size_t MachineIndex(const Scenario& scenario, const std::string& name) {
  return IndexOf(
      scenario.machines, [](const ScenarioMachine& machine) { return machine.placement.name; },
      name, "machine");
}

ObservationPlan PlanObservation(const v1::Observe& observe, const Scenario& scenario,
                                double duration_s) {
  ObservationPlan plan;
  for (const v1::PatchSelection& patch : observe.patches()) {
    plan.patches.push_back(PlanPatch(patch, scenario));
    plan.bytes += PatchBytes(plan.patches.back());
  }
  std::set<std::string> named;
  for (const v1::SensorSelection& selection : observe.sensors()) {
    const ScenarioMachine& machine = scenario.machines[MachineIndex(scenario, selection.machine())];
    const auto& sensors = machine.sensors;
    const SensorDescription& sensor = sensors[IndexOf(
        sensors, [](const SensorDescription& s) { return s.name; }, selection.sensor(),
        fmt::format("sensor of machine '{}'", selection.machine()))];
    const std::string whole_name = selection.machine() + "/" + selection.sensor();
    if (!named.insert(whole_name).second) {
      throw InputError("",
                       {FaultKind::kRepeated,
                        fmt::format("sensor '{}' is asked for twice; need each once", whole_name)});
    }
    const bool latest_only = selection.latest_only() && IsFrame(sensor);
    plan.bytes += SampleBytes(sensor, machine.placement.model) *
                  (latest_only ? 1 : 2 + std::floor(duration_s * sensor.clock.rate_hz));
    plan.sensors.push_back({selection.machine(), selection.sensor(), latest_only});
  }
  CheckSize(plan.bytes, duration_s);
  return plan;
}

void PutState(const WorldState& state, const Scenario& scenario,
              const std::vector<PatchPlan>& patches, v1::Observation* observation) {
  observation->set_time_ns(state.t_ns);
  for (std::size_t m = 0; m < state.machines.size(); ++m) {
    PutMachine(scenario.machines[m].placement, state.machines[m], observation->add_machines());
  }
  for (const PatchPlan& patch : patches) {
    PutPatch(patch, scenario.machines[patch.machine].placement.model, state.machines[patch.machine],
             state.ground().surface(), observation->add_patches());
  }
}

}  // namespace tera
