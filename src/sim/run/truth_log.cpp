#include "sim/run/truth_log.h"

#include "core/types/sample_rows.h"
#include "sim/run/task_log.h"

namespace tera {
namespace {

std::vector<std::string> JointColumns(const MachineModel& model,
                                      const std::vector<SoilType>& soils) {
  std::vector<std::string> columns;
  for (const Joint& joint : model.joints) {
    const bool prismatic = joint.type == JointType::kPrismatic;
    columns.push_back(joint.name + (prismatic ? "_m" : "_rad"));
    columns.push_back(joint.name + (prismatic ? "_mps" : "_radps"));
    columns.push_back(joint.name + (prismatic ? "_n" : "_nm"));
  }
  for (const RunningGear& gear : model.ground_tools.gears) {
    for (const char* unit : {"_rad", "_radps", "_nm", "_sinkage_m", "_slip"}) {
      columns.push_back(gear.name + unit);
    }
  }
  for (const Shovel& shovel : model.ground_tools.shovels) {
    for (const char* of : {"_soil_kg", "_soil_m3", "_soil_x_m", "_soil_y_m", "_soil_z_m"}) {
      columns.push_back(shovel.name + of);
    }
    for (const SoilType& soil : soils)
      columns.push_back(shovel.name + "_soil_" + soil.name + "_kg");
  }
  return columns;
}

/// Values of `now`, with rates that are the means of those before and after it.
std::vector<double> JointRow(const MachineState& now, const MachineState& next, std::size_t soils) {
  std::vector<double> row;
  for (std::size_t j = 0; j < now.q_rad.size(); ++j) {
    const double rate_radps = 0.5 * (now.qd_radps[j] + next.qd_radps[j]);
    row.insert(row.end(), {now.q_rad[j], rate_radps, now.effort_nm[j]});
  }
  for (std::size_t g = 0; g < now.gear_angle_rad.size(); ++g) {
    const double rate_radps = 0.5 * (now.gear_rate_radps[g] + next.gear_rate_radps[g]);
    row.insert(row.end(), {now.gear_angle_rad[g], rate_radps, now.gear_torque_nm[g],
                           now.gear_sinkage_m[g], now.gear_slip[g]});
  }
  for (const SoilReaction::Load& load : now.shovel_load) {
    const Vec3& com_B_m = load.com_B_m;
    row.insert(row.end(), {load.mass_kg, load.volume_m3, com_B_m.x(), com_B_m.y(), com_B_m.z()});
    std::vector<double> soil_kg = load.soil_kg;
    soil_kg.resize(soils);  // the list is empty until the first step
    row.insert(row.end(), soil_kg.begin(), soil_kg.end());
  }
  return row;
}

std::vector<std::string> HydraulicColumns(const MachineModel& model) {
  std::vector<std::string> columns;
  for (const Cylinder& cylinder : model.cylinders) {
    for (const char* unit :
         {"_length_m", "_stroke_m", "_mps", "_n", "_head_pressure_pa", "_rod_pressure_pa"}) {
      columns.push_back(cylinder.name + unit);
    }
  }
  return columns;
}

/// A row of cylinder values, with rates as in JointRow.
std::vector<double> HydraulicRow(const MachineState& now, const MachineState& next) {
  std::vector<double> row;
  for (std::size_t c = 0; c < now.cylinders.size(); ++c) {
    const CylinderState& cylinder = now.cylinders[c];
    const double rate_mps = 0.5 * (cylinder.rate_mps + next.cylinders[c].rate_mps);
    row.insert(row.end(), {cylinder.length_m, cylinder.stroke_m, rate_mps, cylinder.force_n,
                           cylinder.head_pressure_pa, cylinder.rod_pressure_pa});
  }
  return row;
}

/// The channels of a TruthLog.
std::vector<ChannelInfo> StateChannels(const Scenario& scenario) {
  std::vector<ChannelInfo> channels;
  for (const ScenarioMachine& machine : scenario.machines) {
    const MachineModel& model = machine.placement.model;
    const std::string& name = machine.placement.name;
    std::vector<std::string> levers;
    for (const Lever& lever : model.levers) levers.push_back(lever.name);
    channels.push_back(TableChannel(name + "/commands.csv", levers));
    channels.push_back(PoseChannel("truth/" + name + "/pose.csv"));
    channels.push_back(
        TableChannel("truth/" + name + "/joints.csv", JointColumns(model, scenario.site->soils())));
    if (model.cylinders.empty()) continue;
    channels.push_back(TableChannel("truth/" + name + "/hydraulics.csv", HydraulicColumns(model)));
  }
  for (const ScenarioObstacle& obstacle : scenario.obstacles) {
    if (!obstacle.bed) continue;
    channels.push_back(TableChannel("truth/" + obstacle.name + "/bed.csv", {"soil_kg", "soil_m3"}));
  }
  return channels;
}

}  // namespace

std::vector<ChannelInfo> TruthChannels(const Scenario& scenario) {
  std::vector<ChannelInfo> channels = StateChannels(scenario);
  if (scenario.task) channels.push_back(TaskChannel());
  return channels;
}

TruthLog::TruthLog(const Scenario& scenario, MeasurementSink* sink)
    : sink_(sink), soils_(scenario.site->soils().size()) {
  std::vector<ChannelId> ids;
  for (const ChannelInfo& info : StateChannels(scenario)) ids.push_back(sink->AddChannel(info));
  auto next = ids.begin();
  for (const ScenarioMachine& machine : scenario.machines) {
    channels_.push_back({next[0], next[1], next[2], std::nullopt});
    next += 3;
    if (!machine.placement.model.cylinders.empty()) channels_.back().hydraulics = *next++;
  }
  for (const ScenarioObstacle& obstacle : scenario.obstacles) {
    beds_.push_back(obstacle.bed ? std::optional(*next++) : std::nullopt);
  }
}

void TruthLog::WriteRow(ChannelId channel, TimeNs t_ns, const std::vector<double>& values) {
  sink_->Write(channel, RowSample{t_ns, t_ns, values});
}

void TruthLog::WriteStates(const Instant& now, const Instant& next) {
  for (std::size_t m = 0; m < channels_.size(); ++m) {
    const BodyState &root = now.machines[m].links[0], &later = next.machines[m].links[0];
    const Vec3 v_W_mps = 0.5 * (root.v_WB_mps + later.v_WB_mps);
    const Vec3 w_W_radps = 0.5 * (root.w_WB_radps + later.w_WB_radps);
    sink_->Write(channels_[m].pose, RowOf(TruthPose{now.t_ns, root.X_WB, v_W_mps,
                                                    root.X_WB.linear().transpose() * w_W_radps}));
    WriteRow(channels_[m].joints, now.t_ns, JointRow(now.machines[m], next.machines[m], soils_));
    if (!channels_[m].hydraulics) continue;
    WriteRow(*channels_[m].hydraulics, now.t_ns, HydraulicRow(now.machines[m], next.machines[m]));
  }
  for (std::size_t o = 0; o < beds_.size(); ++o) {
    if (!beds_[o]) continue;
    WriteRow(*beds_[o], now.t_ns, {now.beds[o].mass_kg, now.beds[o].volume_m3});
  }
}

void TruthLog::Write(const Instant& before, const Instant& after) {
  for (std::size_t m = 0; m < channels_.size(); ++m) {
    WriteRow(channels_[m].commands, before.t_ns, after.machines[m].levers);
  }
  WriteStates(before, after);
}

}  // namespace tera
