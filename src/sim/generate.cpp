#include "sim/generate.h"

#include <fmt/format.h>

#include "core/error.h"
#include "core/stopwatch.h"
#include "sim/rig.h"
#include "sim/simulation.h"

namespace tera {
namespace {

DatasetInfo InfoOf(const Scenario& scenario, const std::string& resolved_yaml,
                   const SceneModel& scene) {
  DatasetInfo info;
  info.scenario_name = scenario.name;
  info.simulated = true;
  info.seed = scenario.seed;
  info.duration_s = scenario.duration_s;
  info.origin_lat_deg = scenario.origin.lat_deg;
  info.origin_lon_deg = scenario.origin.lon_deg;
  info.origin_height_m = scenario.origin.height_m;
  info.resolved_scenario_yaml = resolved_yaml;
  for (std::size_t i = 1; i < scene.instances.size(); ++i) {
    info.instances.push_back({static_cast<std::uint16_t>(i), scene.instances[i].name,
                              std::string(NameOf(scene.instances[i].label))});
  }
  return info;
}

/// Writes what really happened: poses, joints, loads and commands of every machine.
class TruthLog {
 public:
  TruthLog(const Scenario& scenario, DatasetWriter* writer) : writer_(writer) {
    for (const ScenarioMachine& machine : scenario.machines) {
      const MachineModel& model = machine.placement.model;
      const std::string& name = machine.placement.name;
      std::vector<std::string> levers;
      for (const Lever& lever : model.levers) levers.push_back(lever.name);
      channels_.push_back({writer->AddTable(name + "/commands.csv", levers),
                           writer->AddPose("truth/" + name + "/pose.csv"),
                           writer->AddTable("truth/" + name + "/joints.csv", Columns(model))});
    }
  }

  /// The state, and the levers that `after` was reached with, in force since `before_ns`.
  void Write(TimeNs before_ns, const WorldState& after) {
    for (std::size_t m = 0; m < channels_.size(); ++m) {
      const MachineState& state = after.machines[m];
      if (after.t_ns > 0) writer_->WriteRow(channels_[m].commands, before_ns, state.levers);
      const BodyState& root = state.links[0];
      writer_->Write(channels_[m].pose,
                     TruthPose{after.t_ns, root.X_WB, root.v_WB_mps,
                               root.X_WB.linear().transpose() * root.w_WB_radps});
      writer_->WriteRow(channels_[m].joints, after.t_ns, Row(state));
    }
  }

 private:
  struct Channels {
    ChannelId commands, pose, joints;
  };

  static std::vector<std::string> Columns(const MachineModel& model) {
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
      for (const char* unit : {"_soil_kg", "_soil_m3"}) columns.push_back(shovel.name + unit);
    }
    return columns;
  }

  static std::vector<double> Row(const MachineState& state) {
    std::vector<double> row;
    for (std::size_t j = 0; j < state.q_rad.size(); ++j) {
      row.insert(row.end(), {state.q_rad[j], state.qd_radps[j], state.effort_nm[j]});
    }
    for (std::size_t g = 0; g < state.gear_angle_rad.size(); ++g) {
      row.insert(row.end(), {state.gear_angle_rad[g], state.gear_rate_radps[g],
                             state.gear_torque_nm[g], state.gear_sinkage_m[g], state.gear_slip[g]});
    }
    for (const SoilReaction::Load& load : state.shovel_load) {
      row.insert(row.end(), {load.mass_kg, load.volume_m3});
    }
    return row;
  }

  DatasetWriter* writer_;
  std::vector<Channels> channels_;
};

/// Simulates the scenario into `writer`. `step` counts the steps done, for a caller that must know
/// how far a run came which bad input stopped.
void Run(Scenario& scenario, const SceneAssembly& assembly, const GenerateOptions& options,
         DatasetWriter* writer, std::int64_t* step, GenerateReport* report) {
  const std::int64_t steps = std::llround(scenario.duration_s * scenario.physics_rate_hz);
  // A fifth of a second between progress reports, in steps of simulated time.
  const std::int64_t steps_per_report =
      std::max<std::int64_t>(1, std::llround(scenario.physics_rate_hz / 5));
  Simulation simulation(&scenario);
  TruthLog truth(scenario, writer);
  Rig rig(scenario, assembly, options.egl, options.threads, writer);
  scenario.soil->WriteGeoTiff(writer->PathFor("truth/terrain/height_start.tif"), scenario.origin);

  truth.Write(0, simulation.state());
  rig.SampleStart(simulation);
  while (*step < steps) {
    ++*step;
    simulation.Step();
    truth.Write(simulation.previous().t_ns, simulation.state());
    rig.Sample(simulation);
    if (options.progress && *step % steps_per_report == 0) {
      options.progress(
          {ToSeconds(simulation.state().t_ns), scenario.duration_s, writer->frames_written()});
    }
  }
  scenario.soil->WriteGeoTiff(writer->PathFor("truth/terrain/height_end.tif"), scenario.origin);
  rig.Finish();
  writer->Finish();
  report->simulated_s = scenario.duration_s;
  report->physics_s = simulation.physics_wall_s();
  report->soil_s = simulation.soil_wall_s();
  report->camera_s = rig.camera_wall_s();
  report->lidar_s = rig.lidar_wall_s();
  report->frames = writer->frames_written();
  report->bytes = writer->bytes_written();
}

}  // namespace

GenerateReport Generate(Scenario scenario, const std::string& resolved_yaml,
                        const GenerateOptions& options) {
  GenerateReport report;
  {
    const Stopwatch watch(&report.wall_s);
    const SceneAssembly assembly(scenario);
    DatasetWriter writer(options.out, InfoOf(scenario, resolved_yaml, assembly.model()),
                         {.threads = options.threads, .resume = options.resume});
    std::int64_t step = 0;
    try {
      Run(scenario, assembly, options, &writer, &step, &report);
    } catch (const InputError& error) {
      if (step == 0 && !writer.resumed()) {
        writer.Discard();
        throw;
      }
      throw InputError(
          fmt::format("{}\nwhat was written is kept in {}: finish it by the same command with "
                      "--resume, or delete it",
                      error.what(), writer.incomplete_directory().string()));
    }
  }
  return report;
}

}  // namespace tera
