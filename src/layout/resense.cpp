#include "layout/resense.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/stopwatch.h"
#include "dataset/files/checked_file.h"
#include "dataset/format/events_table.h"
#include "dataset/format/recording.h"
#include "dataset/format/writer.h"
#include "layout/study/cycle.h"
#include "sim/rig.h"
#include "sim/run/pose_log.h"
#include "sim/run/recorded_run.h"
#include "sim/run/run.h"
#include "sim/run/truth_log.h"
#include "sim/state/state_log.h"
#include "sim/state/state_playback.h"

namespace tera {
namespace fs = std::filesystem;
namespace {

constexpr char kTerrainFolder[] = "truth/terrain";

/// Scenario override that puts the rig on the machine.
std::string RigOverride(const fs::path& dataset, const ResenseRig& rig,
                        const std::vector<std::string>& moved) {
  const Scenario scenario = LoadRecordedScenario(dataset, {}, moved).scenario;
  std::vector<std::string> names;
  for (const ScenarioMachine& machine : scenario.machines) names.push_back(machine.placement.name);
  const std::string& wanted = rig.machine.empty() ? names.at(0) : rig.machine;
  const auto found = std::find(names.begin(), names.end(), wanted);
  if (found == names.end()) {
    throw InputError(
        "--machine " + wanted,
        {FaultKind::kNoSuchName, fmt::format("{} has no such machine; its machines are {}",
                                             dataset.string(), fmt::join(names, ", "))});
  }
  return fmt::format("machines[{}].rig={}", found - names.begin(),
                     fs::absolute(rig.file).lexically_normal().string());
}

/// Copies the truth of `dataset`, since the truth does not depend on the rig.
void TakeOverTruth(const fs::path& dataset, const Scenario& scenario, DatasetWriter* writer) {
  for (const ChannelInfo& info : TruthChannels(scenario)) {
    writer->AddWholeTable(info, dataset / info.path);
  }
  std::error_code ignored;
  if (!fs::is_directory(dataset / kTerrainFolder, ignored)) return;
  for (const fs::directory_entry& entry : fs::directory_iterator(dataset / kTerrainFolder)) {
    const fs::path file = fs::path(kTerrainFolder) / entry.path().filename();
    WriteWholeFile(writer->PathFor(file.string()), ReadWholeFile(entry.path()));
  }
}

/// Runs the sensors over the whole recorded run.
void MeasureAgain(const Scenario& scenario, const SceneAssembly& assembly,
                  const GenerateOptions& options, StatePlayback* playback, DatasetWriter* writer,
                  GenerateReport* report) {
  const std::int64_t steps = std::llround(scenario.duration_s * scenario.physics_rate_hz);
  const std::int64_t steps_per_report =
      std::max<std::int64_t>(1, std::llround(scenario.physics_rate_hz / 5));
  PoseLog poses(scenario, writer);
  poses.WriteStart(playback->state());
  Rig rig(scenario, assembly, options.egl, options.threads, writer);
  rig.SampleStart(playback->state(), playback->ground());
  for (std::int64_t step = 1; playback->Step(); ++step) {
    if (step > steps) {
      rig.Finish(playback->last_step());
      continue;
    }
    poses.Write(playback->last_step().before, playback->last_step().after);
    rig.Sample(playback->last_step());
    if (options.progress && step % steps_per_report == 0) {
      options.progress(
          {ToSeconds(playback->state().t_ns), scenario.duration_s, writer->frames_written()});
    }
  }
  report->camera_s = rig.camera_wall_s();
  report->camera_wait_s = rig.camera_wait_s();
  report->lidar_s = rig.lidar_wall_s();
}

}  // namespace

GenerateReport Resense(const fs::path& dataset, const ResenseRig& rig,
                       const std::vector<std::string>& moved, const GenerateOptions& options) {
  GenerateReport report;
  {
    const Stopwatch watch(&report.wall_s);
    RequireState(dataset);
    RequireRigFile(rig.file);
    const LoadedScenario loaded =
        LoadRecordedScenario(dataset, {RigOverride(dataset, rig, moved)}, moved);
    const Scenario& scenario = loaded.scenario;
    const SceneAssembly assembly(scenario);
    StatePlayback playback(scenario, ReadWholeFile(dataset / "scenario.yaml"),
                           dataset / kStateFile);
    const DatasetInfo info = InfoOf(scenario, loaded.resolved_yaml, assembly.model());
    if (options.resume && DatasetWriter::FinishWhole(options.out, info)) return {};
    DatasetWriter writer(options.out, info, {.threads = options.threads, .resume = options.resume});
    try {
      TakeOverTruth(dataset, scenario, &writer);
      MeasureAgain(scenario, assembly, options, &playback, &writer, &report);
      if (Recording(dataset).Has(kEventsFile)) {
        writer.AddWholeTable(EventsChannel(), dataset / kEventsFile);
      }
      writer.Finish();
    } catch (const InputError&) {
      if (!writer.resumed()) writer.Discard();
      throw;
    }
    report.simulated_s = scenario.duration_s;
    report.frames = writer.frames_written();
    report.bytes = writer.bytes_written();
  }
  return report;
}

}  // namespace tera
