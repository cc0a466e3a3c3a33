#include "sim/run/generate.h"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "core/error.h"
#include "core/stopwatch.h"
#include "sim/run/run.h"
#include "sim/run/terrain_log.h"
#include "sim/state/state_log.h"

namespace tera {
namespace {

/// Creates the state log of a run, if it is requested.
std::optional<StateLog> StateLogOf(const Scenario& scenario, const std::string& resolved_yaml,
                                   const GenerateOptions& options, const Run& run,
                                   DatasetWriter* writer) {
  if (!options.keep_state) return std::nullopt;
  return std::optional<StateLog>(std::in_place, scenario, resolved_yaml,
                                 writer->PathFor(kStateFile), run.simulation().state());
}

/// Runs the scenario to its end and writes to `writer`. `step` counts the completed steps, so that
/// the caller knows the progress if an exception ends the run.
void RunToEnd(const Scenario& scenario, const std::string& resolved_yaml,
              const SceneAssembly& assembly, const GenerateOptions& options, DatasetWriter* writer,
              std::int64_t* step, GenerateReport* report) {
  const std::int64_t steps = std::llround(scenario.duration_s * scenario.physics_rate_hz);
  // A fifth of a second of simulated time between progress reports.
  const std::int64_t steps_per_report =
      std::max<std::int64_t>(1, std::llround(scenario.physics_rate_hz / 5));
  Run run(scenario, OperatorsOf(scenario), assembly, options.egl, options.threads, writer);
  TerrainLog terrain(scenario, run.simulation().state().ground(), writer);
  std::optional<StateLog> states = StateLogOf(scenario, resolved_yaml, options, run, writer);
  while (*step < steps && !run.task().IsDone()) {
    ++*step;
    run.Step();
    terrain.Write(run.simulation().state().t_ns);
    if (states) states->Add(run.simulation().state());
    if (options.progress && *step % steps_per_report == 0) {
      options.progress({ToSeconds(run.simulation().state().t_ns), scenario.duration_s,
                        writer->frames_written()});
    }
  }
  terrain.Finish();
  if (run.task().HasTask()) run.task().WriteMap(writer->PathFor(kDeviationMap));
  run.WriteEvents(writer);
  run.Finish();
  if (states) {
    states->Add(run.simulation().state());
    states->Commit();
  }
  if (*step < steps) writer->SetDuration(static_cast<double>(*step) / scenario.physics_rate_hz);
  writer->Finish();
  report->task = run.task().deviation();
  report->task_done = run.task().IsDone();
  report->simulated_s = static_cast<double>(*step) / scenario.physics_rate_hz;
  report->physics_s = run.simulation().physics_wall_s();
  report->soil_s = run.simulation().soil_wall_s();
  report->camera_s = run.rig().camera_wall_s();
  report->camera_wait_s = run.rig().camera_wait_s();
  report->lidar_s = run.rig().lidar_wall_s();
  report->frames = writer->frames_written();
  report->bytes = writer->bytes_written();
}

}  // namespace

GenerateReport Generate(const Scenario& scenario, const std::string& resolved_yaml,
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
      RunToEnd(scenario, resolved_yaml, assembly, options, &writer, &step, &report);
    } catch (const InputError& error) {
      if (step == 0 && !writer.resumed()) {
        writer.Discard();
        throw;
      }
      auto faults = error.faults();
      faults.emplace_back(
          fmt::format("the incomplete dataset is kept in {}: finish it by the same command with "
                      "--resume, or delete it",
                      writer.incomplete_directory().string()));
      throw InputError(std::move(faults));
    }
  }
  return report;
}

}  // namespace tera
