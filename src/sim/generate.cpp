#include "sim/generate.h"

#include <fmt/format.h>

#include "core/error.h"
#include "core/stopwatch.h"
#include "sim/rig.h"
#include "sim/simulation.h"
#include "sim/truth_log.h"

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

  rig.SampleStart(simulation);
  while (*step < steps) {
    ++*step;
    simulation.Step();
    truth.Write(simulation.previous(), simulation.state());
    rig.Sample(simulation);
    if (options.progress && *step % steps_per_report == 0) {
      options.progress(
          {ToSeconds(simulation.state().t_ns), scenario.duration_s, writer->frames_written()});
    }
  }
  scenario.soil->WriteGeoTiff(writer->PathFor("truth/terrain/height_end.tif"), scenario.origin);
  truth.Finish(simulation.state());
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
    const DatasetInfo info = InfoOf(scenario, resolved_yaml, assembly.model());
    if (options.resume && DatasetWriter::FinishWhole(options.out, info)) return {};
    DatasetWriter writer(options.out, info, {.threads = options.threads, .resume = options.resume});
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
