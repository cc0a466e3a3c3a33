#include "app/diagnose_recording.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "app/diagnose_progress.h"
#include "app/diagnose_simulation.h"
#include "app/ground_map_file.h"
#include "app/perception_run.h"
#include "app/stage_clock.h"
#include "core/error.h"
#include "dataset/files/whole_folder.h"
#include "dataset/format/recording.h"
#include "diagnose/blocks/measured_poses.h"
#include "diagnose/diagnosis.h"
#include "diagnose/report/files/baselines_json.h"
#include "diagnose/report/files/write_report.h"
#include "diagnose/report/text/sentence.h"
#include "diagnose/report/text/summary.h"
#include "sim/operators/lever_replay.h"

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

/// The levers that the scenario replays; none where it replays none.
TableRecording ReplayedCommands(const ScenarioMachine& machine) {
  TableRecording commands;
  const MachineModel& model = machine.placement.model;
  CommandTable table = ReplayedLevers(machine.driver.get(), model);
  if (table.t_ns.empty()) return commands;
  for (const Lever& lever : model.levers) commands.columns.push_back(lever.name);
  commands.t_ns = std::move(table.t_ns);
  commands.rows = std::move(table.rows);
  return commands;
}

/// One machine of the scenario and what the diagnosis is to know of it.
struct MachineCase {
  const Scenario& scenario;
  std::size_t index = 0;
  MachineModel model;  ///< joints that nothing measures stay where the scenario has them

  MachineCase(const Scenario& of, std::size_t machine)
      : scenario(of), index(machine), model(of.machines[machine].placement.model) {
    for (std::size_t j = 0; j < model.joints.size(); ++j) {
      model.joints[j].initial_rad = of.machines[machine].placement.q_rad[j];
    }
  }
  DiagnosisInput InputOf(const Recording& recording) const {
    const ScenarioMachine& machine = scenario.machines[index];
    const std::string& name = machine.placement.name;
    const std::string recorded = NameInRecording(name, scenario.machines.size(), recording);
    DiagnosisInput input{.model = &model, .machine = recorded, .scenario = name};
    input.sensors = machine.sensors;
    if (const std::string file = recorded + "/commands.csv"; recording.Has(file)) {
      input.commands = recording.LoadTable(file);
    } else {
      input.commands = ReplayedCommands(machine);
      input.commands_are_the_scenarios = !input.commands.columns.empty();
    }
    return input;
  }
};

DiagnosisOptions OptionsOf(const DiagnoseArguments& arguments, std::uint64_t seed) {
  DiagnosisOptions options{.seed = seed};
  options.search.threads = options.blocks.threads = arguments.threads;
  if (arguments.from_s) options.measurements.from_s = *arguments.from_s;
  if (arguments.to_s) options.measurements.to_s = *arguments.to_s;
  if (arguments.library) options.library = ReadCandidateLibrary(*arguments.library);
  options.time_limit_s = arguments.time_limit_s;
  return options;
}

/// The scenario as it is under the levers of the recording, where that is wanted.
std::optional<SimulatedCourse> CourseOf(const DiagnoseArguments& arguments,
                                        const MachineCase& machine, const DiagnosisInput& input,
                                        const Measurements& measured) {
  if (!arguments.simulate) return std::nullopt;
  return SimulateAsItIs(arguments.scenario, machine.index, input, measured);
}

/// A recording that nothing is fitted to.
struct Further {
  DiagnosisInput input;
  Measurements measured;
  std::vector<ReplayBlock> blocks;
};

/// The further recordings, before anything is searched: what cannot be read is told at once.
std::vector<Further> FurtherRecordings(const DiagnoseArguments& arguments,
                                       const MachineCase& machine, std::uint64_t seed) {
  std::vector<Further> further;
  const BlockOptions options{.threads = arguments.threads};
  for (const std::filesystem::path& path : arguments.held_out) {
    const Recording recording(path);
    const DiagnosisInput input = machine.InputOf(recording);
    Measurements measured = MeasurementsOf(input, recording);
    std::vector<ReplayBlock> blocks = BlocksOf(input, measured, options);
    if (const auto course = CourseOf(arguments, machine, input, measured)) {
      CorrectDiscrepancies(ReplayDiscrepanciesOf(input, measured, options, *course), seed,
                           options.threads, &blocks);
    }
    ExcludeLaggingSamples(&blocks);
    further.push_back({input, std::move(measured), std::move(blocks)});
  }
  return further;
}

/// What was found, over a further recording, whose sensors are compared as those of the first were.
HeldOutRecording JudgeFurther(const Diagnosis& diagnosis, Further* further,
                              const std::filesystem::path& recording,
                              const DiagnosisOptions& options) {
  if (FindsArrivalStamps(diagnosis.blocks)) {
    std::vector<std::string> not_compared;  // as in the recording that is searched
    TakeSensorBlocks(further->input.machine, &further->blocks);
    for (ReplayBlock& block :
         SensorBlocksByArrivals(further->input, further->measured, options.blocks, &not_compared)) {
      // Without a block of the base they were not told from the machine's own.
      std::erase_if(further->blocks,
                    [&](const ReplayBlock& stamped) { return stamped.name == block.name; });
      further->blocks.push_back(std::move(block));
    }
  }
  return ValidateHeldOut(diagnosis.blocks, further->blocks, recording.string(), options.seed);
}

/// Any that a simulation can have: poses are not simulated late.
bool HasFindingsToSimulate(const Diagnosis& diagnosis) {
  return std::any_of(diagnosis.blocks.begin(), diagnosis.blocks.end(),
                     [](const DiagnosedBlock& diagnosed) {
                       return !WithoutPoseTerms(diagnosed.diagnosis.search.found.terms).empty();
                     });
}

bool IsOutOfTime(const Diagnosis& diagnosis) {
  return std::any_of(
      diagnosis.blocks.begin(), diagnosis.blocks.end(),
      [](const DiagnosedBlock& diagnosed) { return diagnosed.diagnosis.out_of_time; });
}

/// A folder for each, where there are several.
void WriteReports(const DiagnoseArguments& arguments, const std::vector<Diagnosis>& diagnoses,
                  const SiteOrigin& origin, WholeFolder* out) {
  const auto of_machine = [&](const std::filesystem::path& folder, const Diagnosis& diagnosis) {
    return diagnoses.size() == 1 ? folder : folder / diagnosis.machine;
  };
  for (const Diagnosis& diagnosis : diagnoses) {
    const std::filesystem::path folder = of_machine(out->temporary(), diagnosis);
    WriteReport(folder, diagnosis, arguments.recording.string());
    WriteGroundMaps(folder, diagnosis, origin);
  }
  out->Commit();
  for (const Diagnosis& diagnosis : diagnoses) {
    fmt::print("report: {}\n", (of_machine(arguments.out, diagnosis) / "report.html").string());
  }
}

/// `seen`: what its lidars and cameras show.
Diagnosis DiagnoseMachine(const DiagnoseArguments& arguments, DiagnosisOptions options,
                          const MachineCase& machine, const Recording& recording,
                          std::vector<PerceptionDiagnosis> seen, StageClock* clock) {
  options.measurements.needs_any = options.blocks.needs_any = seen.empty();
  auto further = clock->Time("further recordings",
                             [&] { return FurtherRecordings(arguments, machine, options.seed); });
  const DiagnosisInput input = machine.InputOf(recording);
  std::optional<SimulatedCourse> course;
  const auto simulate = [&](const Measurements& measured) {
    return clock->Time("simulation as it is",
                       [&] { return course = CourseOf(arguments, machine, input, measured); });
  };
  DiagnoseProgress bar(input.machine, clock);
  Diagnosis diagnosis = Diagnose(input, recording, options, simulate,
                                 [&](const BlockProgress& progress) { bar.Show(progress); });
  diagnosis.perception = std::move(seen);
  for (std::size_t r = 0; r < further.size(); ++r) {
    diagnosis.held_out.push_back(
        JudgeFurther(diagnosis, &further[r], arguments.held_out[r], options));
  }
  if (!arguments.simulate || !HasFindingsToSimulate(diagnosis)) return diagnosis;
  if (IsOutOfTime(diagnosis)) {
    diagnosis.whole = WholeSimulation{};
    diagnosis.whole->obstacle = "the time was over";
  } else {
    diagnosis.whole = clock->Time("whole simulation", [&] {
      return SimulateWhole(arguments.scenario, machine.index, input, recording, options, diagnosis,
                           course);
    });
  }
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

/// That none of the further recordings is the one that is searched.
void RequireOthers(const DiagnoseArguments& arguments) {
  for (const std::filesystem::path& further : arguments.held_out) {
    std::error_code none;
    if (!std::filesystem::equivalent(further, arguments.recording, none)) continue;
    throw InputError(fmt::format(
        "--held-out {}: is the recording that is searched; need one that nothing is fitted to",
        further.string()));
  }
}

}  // namespace

void RequireNewFolder(const std::filesystem::path& out) {
  RequireNoneStopped(out);
  if (!std::filesystem::exists(out)) return;
  throw InputError(
      fmt::format("{}: exists already; need the name of a new folder, for a report of "
                  "its own",
                  out.string()));
}

std::string BaselinesOfRecording(const DiagnoseArguments& arguments) {
  const LoadedScenario loaded = Load(arguments.scenario);
  const Recording recording(arguments.recording);
  const MachineCase machine(loaded.scenario, 0);
  const DiagnosisOptions options = OptionsOf(arguments, loaded.scenario.seed);
  std::vector<BlockBaselines> blocks;
  const DiagnosisInput input = machine.InputOf(recording);
  const Measurements measured = MeasurementsOf(input, recording, options.measurements);
  std::vector<ReplayBlock> replayed = BlocksOf(input, measured, options.blocks);
  ExcludeLaggingSamples(&replayed);
  for (const ReplayBlock& block : replayed) {
    const Stream stream = StreamOf(block, options.seed);
    BlockBaselines baselines{{}, RmseAsItIs(block, stream), {}};
    for (const Channel& channel : block.channels) baselines.channels.push_back(channel.name);
    baselines.answers = BaselinesOf(block, arguments.threads, stream);
    blocks.push_back(std::move(baselines));
  }
  return BaselinesJson(blocks);
}

void DiagnoseRecording(const DiagnoseArguments& arguments) {
  StageClock clock;
  RequireNewFolder(arguments.out);
  RequireOthers(arguments);
  LoadedScenario loaded = Load(arguments.scenario);
  const Recording recording(arguments.recording);
  const DiagnosisOptions options = OptionsOf(arguments, loaded.scenario.seed);
  WholeFolder out(arguments.out);  // one that cannot be written is not worth a search
  auto seen = clock.Time("lidars and cameras",
                         [&] { return DiagnoseSensors(arguments, &loaded.scenario, recording); });
  std::vector<Diagnosis> diagnoses;
  for (std::size_t m = 0; m < loaded.scenario.machines.size(); ++m) {
    diagnoses.push_back(DiagnoseMachine(arguments, options, MachineCase(loaded.scenario, m),
                                        recording, std::move(seen[m]), &clock));
  }
  for (const Diagnosis& diagnosis : diagnoses) {
    if (const std::string summary = SummaryOf(diagnosis); !summary.empty()) {
      fmt::print("{}\n", summary);
    }
    for (const std::string& sentence : SentencesOf(diagnosis)) fmt::print("{}\n", sentence);
  }
  WriteReports(arguments, diagnoses, loaded.scenario.origin, &out);
  if (arguments.profile) fmt::print("{}", clock.Table());
}

}  // namespace tera
