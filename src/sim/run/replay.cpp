#include "sim/run/replay.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/error.h"
#include "sim/operators/lever_replay.h"

namespace tera {
namespace {

std::string CommandsOf(const MachinePlacement& machine) { return machine.name + "/commands.csv"; }

/// `shown` is the file of the table, for messages.
LeverReplayPlan Replayed(TableRecording table, const MachinePlacement& machine,
                         const std::string& shown) {
  std::vector<std::string> names;
  for (const Lever& lever : machine.model.levers) names.push_back(lever.name);
  if (table.columns != names) {
    throw InputError(shown, fmt::format("the columns are not the levers of machine '{}'; need the "
                                        "scenario.yaml of the recording",
                                        machine.name));
  }
  std::vector<int> lever_of_column;
  for (std::size_t i = 0; i < names.size(); ++i) lever_of_column.push_back(static_cast<int>(i));
  CommandTable commands{std::move(table.t_ns), std::move(table.rows)};
  for (std::size_t r = 0; r < commands.rows.size(); ++r) {
    for (const double lever : commands.rows[r]) {
      if (std::abs(lever) <= 1) continue;
      throw InputError(
          shown, {FaultKind::kOutOfRange,
                  fmt::format("a lever is {} at t_ns {}, need -1 to 1", lever, commands.t_ns[r])});
    }
  }
  return {std::make_shared<const CommandTable>(std::move(commands)), std::move(lever_of_column)};
}

LeverReplayPlan AsRecorded(const Recording& recording, const MachinePlacement& machine) {
  const std::string file = CommandsOf(machine);
  const std::string shown = (recording.directory() / file).string();
  if (!recording.Has(file)) {
    throw InputError(shown, fmt::format("is not part of the recording; need the commands of '{}'",
                                        machine.name));
  }
  return Replayed(recording.LoadTable(file), machine, shown);
}

}  // namespace

void RequireSimulated(const Recording& recording) {
  if (recording.info().simulated) return;
  throw InputError(recording.directory().string(),
                   "is a real recording; need a simulated one (a scenario replays real levers with "
                   "`operator: {type: lever_replay}`)");
}

void CommandAsRecorded(const Recording& recording, Scenario* scenario) {
  for (ScenarioMachine& machine : scenario->machines) {
    machine.driver = AsRecorded(recording, machine.placement);
  }
  scenario->duration_s = recording.info().duration_s;
}

void CommandAsFarAsRecorded(const std::filesystem::path& directory, Scenario* scenario) {
  std::size_t steps = std::numeric_limits<std::size_t>::max();
  for (ScenarioMachine& machine : scenario->machines) {
    const std::string file = CommandsOf(machine.placement);
    TableRecording table = LoadStoppedTable(directory, file);
    steps = std::min(steps, table.t_ns.size());
    machine.driver = Replayed(std::move(table), machine.placement, (directory / file).string());
  }
  // The last row contains the levers at the end; no step follows it.
  if (steps < 2) {
    throw InputError(
        directory.string(),
        {FaultKind::kMalformed, "was stopped before it wrote a command to the disk; delete it"});
  }
  scenario->duration_s = static_cast<double>(steps - 1) / scenario->physics_rate_hz;
}

}  // namespace tera
