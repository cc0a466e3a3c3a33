#include "layout/study/cycle.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "core/error.h"
#include "dataset/files/checked_file.h"
#include "sim/run/recorded_run.h"
#include "sim/simulation.h"
#include "sim/state/state_log.h"
#include "sim/state/state_playback.h"

namespace tera {
namespace fs = std::filesystem;
namespace {

std::string RigOverride(std::size_t machine, const fs::path& file) {
  return fmt::format("machines[{}].rig={}", machine,
                     fs::absolute(file).lexically_normal().string());
}

}  // namespace

Cycle::Cycle(const fs::path& dataset_or_scenario, std::vector<std::string> moved)
    : moved_(std::move(moved)) {
  std::error_code ignored;
  if (!fs::exists(dataset_or_scenario, ignored)) {
    throw InputError(dataset_or_scenario.string(),
                     {FaultKind::kNoSuchName,
                      "no such dataset or scenario; need the folder of a dataset that `tera "
                      "generate --keep-state` wrote, or a scenario file (YAML)"});
  }
  if (!fs::is_directory(dataset_or_scenario, ignored)) {
    scenario_file_ = dataset_or_scenario;
    loaded_ = LoadScenario(scenario_file_, {});
    return;
  }
  dataset_ = dataset_or_scenario;
  RequireState(dataset_);
  loaded_ = LoadRecordedScenario(dataset_, {}, moved_);
}

void RequireRigFile(const fs::path& file) {
  std::error_code ignored;
  if (fs::is_regular_file(file, ignored)) return;
  throw InputError(file.string(),
                   {FaultKind::kUnreadable,
                    fmt::format("{}; need a rig file (YAML)",
                                fs::is_directory(file, ignored) ? "is a folder" : "no such file")});
}

Scenario Cycle::WithRig(std::size_t machine, const fs::path& file) const {
  RequireRigFile(file);
  const std::vector<std::string> rig = {RigOverride(machine, file)};
  return is_dataset() ? LoadRecordedScenario(dataset_, rig, moved_).scenario
                      : LoadScenario(scenario_file_, rig).scenario;
}

void Cycle::ForEachStep(const Visit& visit) const {
  const Scenario& scenario = loaded_.scenario;
  const auto steps = std::llround(scenario.duration_s * scenario.physics_rate_hz);
  if (is_dataset()) {
    StatePlayback playback(scenario, loaded_.resolved_yaml, dataset_ / kStateFile);
    visit(playback.state(), playback.ground());
    // The step after the end of the run is not part of the cycle.
    for (std::int64_t step = 1; playback.Step(); ++step) {
      if (step <= steps) visit(playback.state(), playback.ground());
    }
    return;
  }
  Simulation simulation(scenario);
  visit(simulation.state(), simulation.ground());
  for (std::int64_t step = 0; step < steps; ++step) {
    simulation.Step();
    visit(simulation.state(), simulation.ground());
  }
}

void Cycle::ForEachMoment(double rate_hz, const Visit& visit, const Visit& on_step) const {
  const SampleClock clock{.rate_hz = rate_hz, .start_ns = 0};
  const TimeNs half_step_ns = FromSeconds(0.5 / loaded_.scenario.physics_rate_hz);
  std::int64_t next = 0;
  ForEachStep([&](const Instant& now, const TerrainSurface& ground) {
    if (on_step) on_step(now, ground);
    const TimeNs until_ns = now.t_ns + half_step_ns;  // at later times the next step is nearer
    if (until_ns < clock.Due(next)) return;
    visit(now, ground);
    while (clock.Due(next) <= until_ns) ++next;
  });
}

}  // namespace tera
