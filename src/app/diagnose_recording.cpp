#include "app/diagnose_recording.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/perception_run.h"
#include "core/error.h"
#include "dataset/recording.h"
#include "diagnose/diagnosis.h"
#include "diagnose/report/baselines_json.h"
#include "diagnose/report/sentence.h"
#include "diagnose/report/write_report.h"
#include "sim/lever_replay.h"

namespace tera {
namespace {

/// The machine of the recording that a machine of the scenario is meant to be: of the same name, or
/// the only one where each side has one.
std::string NameInRecording(const std::string& name, std::size_t in_scenario,
                            const Recording& recording) {
  const std::vector<std::string> names = recording.Machines();
  if (std::find(names.begin(), names.end(), name) != names.end()) return name;
  if (in_scenario == 1 && names.size() == 1) return names.front();
  throw InputError(fmt::format("{}: has no machine '{}', but {}; need the names of the scenario",
                               recording.directory().string(), name, fmt::join(names, ", ")));
}

/// The levers that were recorded, else those that the scenario replays.
TableRecording CommandsOf(const Recording& recording, const std::string& name,
                          const ScenarioMachine& machine) {
  if (const std::string file = name + "/commands.csv"; recording.Has(file)) {
    return recording.LoadTable(file);
  }
  TableRecording commands;
  const MachineModel& model = machine.placement.model;
  CommandTable table = ReplayedLevers(machine.driver.get(), model);
  if (table.t_ns.empty()) return commands;
  for (const Lever& lever : model.levers) commands.columns.push_back(lever.name);
  commands.t_ns = std::move(table.t_ns);
  commands.rows = std::move(table.rows);
  return commands;
}

/// What the diagnosis of one machine is of.
struct MachineCase {
  MachineModel model;
  DiagnosisInput input;  ///< points to the model
  DiagnosisOptions options;
};

std::unique_ptr<MachineCase> CaseOf(const DiagnoseArguments& arguments, const Scenario& scenario,
                                    const ScenarioMachine& machine, const Recording& recording) {
  const std::string name =
      NameInRecording(machine.placement.name, scenario.machines.size(), recording);
  auto out = std::make_unique<MachineCase>();
  // Joints that nothing measures stay where the scenario has them.
  out->model = machine.placement.model;
  for (std::size_t j = 0; j < out->model.joints.size(); ++j) {
    out->model.joints[j].initial_rad = machine.placement.q_rad[j];
  }
  out->input = {&out->model, name, machine.placement.name, CommandsOf(recording, name, machine),
                machine.sensors};
  out->options.seed = scenario.seed;
  out->options.search.threads = arguments.threads;
  if (arguments.from_s) out->options.from_s = *arguments.from_s;
  if (arguments.to_s) out->options.to_s = *arguments.to_s;
  return out;
}

/// `seen`: what its lidars and cameras show.
Diagnosis DiagnoseMachine(const DiagnoseArguments& arguments, const Scenario& scenario,
                          const ScenarioMachine& machine, const Recording& recording,
                          std::vector<PerceptionDiagnosis> seen) {
  const auto one = CaseOf(arguments, scenario, machine, recording);
  one->options.needs_blocks = seen.empty();
  Diagnosis diagnosis =
      Diagnose(one->input, recording, one->options, [&](const std::string& block) {
        fmt::print(stderr, "{}: {}\n", one->input.machine, block);
      });
  diagnosis.perception = std::move(seen);
  return diagnosis;
}

std::vector<std::vector<PerceptionDiagnosis>> DiagnoseSensors(const DiagnoseArguments& arguments,
                                                              Scenario* scenario,
                                                              const Recording& recording) {
  std::vector<std::string> names;
  for (const ScenarioMachine& machine : scenario->machines) {
    names.push_back(NameInRecording(machine.placement.name, scenario->machines.size(), recording));
  }
  PerceptionOptions options;
  options.threads = arguments.threads;
  options.from_s = arguments.from_s.value_or(options.from_s);
  options.to_s = arguments.to_s.value_or(options.to_s);
  return RunPerception(scenario, names, recording, options);
}

}  // namespace

void RequireNewFolder(const std::filesystem::path& out) {
  if (!std::filesystem::exists(out)) return;
  throw InputError(
      fmt::format("{}: exists already; need a folder that does not, for a report of "
                  "its own",
                  out.string()));
}

std::string BaselinesOfRecording(const DiagnoseArguments& arguments) {
  const LoadedScenario loaded = Load(arguments.scenario);
  const Recording recording(arguments.recording);
  const auto one = CaseOf(arguments, loaded.scenario, loaded.scenario.machines.front(), recording);
  std::vector<BlockBaselines> blocks;
  for (const ReplayBlock& block : BlocksOf(one->input, recording, one->options)) {
    const Stream stream = StreamOf(block, one->options.seed);
    BlockBaselines baselines{{}, RmseAsItIs(block, stream), {}};
    for (const Channel& channel : block.channels) baselines.channels.push_back(channel.name);
    baselines.answers = BaselinesOf(block, arguments.threads, stream);
    blocks.push_back(std::move(baselines));
  }
  return BaselinesJson(blocks);
}

void DiagnoseRecording(const DiagnoseArguments& arguments) {
  RequireNewFolder(arguments.out);
  LoadedScenario loaded = Load(arguments.scenario);
  const Recording recording(arguments.recording);
  auto seen = DiagnoseSensors(arguments, &loaded.scenario, recording);
  const auto& machines = loaded.scenario.machines;
  std::vector<Diagnosis> diagnoses;
  for (std::size_t m = 0; m < machines.size(); ++m) {
    diagnoses.push_back(
        DiagnoseMachine(arguments, loaded.scenario, machines[m], recording, std::move(seen[m])));
  }
  for (const Diagnosis& diagnosis : diagnoses) {
    for (const std::string& sentence : SentencesOf(diagnosis)) fmt::print("{}\n", sentence);
    const auto folder = diagnoses.size() == 1 ? arguments.out : arguments.out / diagnosis.machine;
    WriteReport(folder, diagnosis, arguments.recording.string());
    fmt::print("report: {}\n", (folder / "report.html").string());
  }
}

}  // namespace tera
