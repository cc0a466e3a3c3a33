#include "diagnose/diagnose_recording.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "dataset/compare/time_alignment.h"
#include "diagnose/blocks/candidate_list.h"
#include "diagnose/perception/perception_run.h"
#include "diagnose/search/structure/baselines.h"
#include "physics/actuation/axes.h"
#include "sim/operators/lever_replay.h"

namespace tera {
namespace {

using Json = nlohmann::ordered_json;

/// Adds values by the names of a block's channels.
void Put(const ReplayBlock& block, const std::vector<double>& values, Json* map) {
  for (std::size_t c = 0; c < values.size(); ++c) (*map)[block.channels[c].name] = values[c];
}

void Add(const ReplayBlock& block, const BaselineAnswer& answer, Json* method) {
  if (answer.found) (*method)["found"] = true;
  for (const NamedMechanism& name : answer.names) {
    (*method)["names"].push_back({{"mechanism", name.mechanism}, {"target", name.target}});
  }
  Put(block, answer.rmse_final, &(*method)["rmse"]);
}

/// Name of a scenario's machine in the recording: the same name, or the only machine if scenario
/// and recording have just one.
std::string NameInRecording(const std::string& name, std::size_t in_scenario,
                            const Recording& recording) {
  const std::vector<std::string> names = recording.Machines();
  if (std::find(names.begin(), names.end(), name) != names.end()) return name;
  if (in_scenario == 1 && names.size() == 1) return names.front();
  throw InputError(recording.directory().string(),
                   {FaultKind::kNoSuchName,
                    fmt::format("has no machine '{}', but {}; need the names of the scenario", name,
                                fmt::join(names, ", "))});
}

/// Levers that the scenario replays; empty if it replays none.
TableRecording ReplayedCommands(const ScenarioMachine& machine) {
  TableRecording commands;
  const MachineModel& model = machine.placement.model;
  CommandTable table = ReplayedLevers(machine.driver, model);
  if (table.t_ns.empty()) return commands;
  for (const Lever& lever : model.levers) commands.columns.push_back(lever.name);
  commands.t_ns = std::move(table.t_ns);
  commands.rows = std::move(table.rows);
  return commands;
}

/// One machine of the scenario, with the model for its diagnosis.
struct MachineCase {
  const Scenario& scenario;
  std::size_t index = 0;
  MachineModel model;  ///< joints start at the scenario's positions

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
    input.tolerances = machine.tolerances;
    if (const std::string file = recorded + "/commands.csv"; recording.Has(file)) {
      input.commands = recording.LoadTable(file);
    } else {
      input.commands = ReplayedCommands(machine);
      input.commands_are_the_scenarios = !input.commands.columns.empty();
    }
    return input;
  }
};

DiagnosisOptions OptionsOf(const DiagnosisTask& task, std::uint64_t seed) {
  DiagnosisOptions options{.seed = seed};
  options.search.threads = options.blocks.threads = task.threads;
  if (task.from_s) options.measurements.from_s = *task.from_s;
  if (task.to_s) options.measurements.to_s = *task.to_s;
  options.library = task.library;
  options.time_limit_s = task.time_limit_s;
  return options;
}

/// Initial pose and ground of a machine in the scenario. Level ground is left out, because a
/// scenario without measured heights has it too.
KnownPlace KnownPlaceOf(const Scenario& scenario, std::size_t machine) {
  const std::shared_ptr<const Site> site = scenario.site;
  KnownPlace place{scenario.machines[machine].placement.X_WB, {}};
  const TerrainSurface& surface = site->surface();
  bool is_level = true;
  for (int i = 0; is_level && i < surface.nx; ++i) {
    for (int j = 0; is_level && j < surface.ny; ++j) {
      is_level = surface.HeightAt(surface.x_m(i), surface.y_m(j)) == surface.HeightAt(0, 0);
    }
  }
  if (is_level) return place;
  place.ground = [site](double x_m, double y_m) { return site->surface().HeightAt(x_m, y_m); };
  return place;
}

SimulateMachine SimulatorOf(const Scenario& scenario, std::size_t machine) {
  return [&scenario, machine](const SimulatedFindings& found, const TableRecording& levers,
                              const CourseSpan& span) {
    if (found.empty()) return SimulateUnderLevers(scenario, machine, levers, span);
    Scenario changed = scenario;
    MachineModel& model = changed.machines[machine].placement.model;
    model = WithTerms(std::move(model), found.terms);
    model.effects.learned.resize(model.joints.size() + model.gear_drives.size());
    for (const LearnedOfAxis& one : found.learned) {
      model.effects.learned.at(static_cast<std::size_t>(AxisNamed(model, one.axis))) = one.effect;
    }
    return SimulateUnderLevers(changed, machine, levers, span);
  };
}

std::vector<std::vector<PerceptionDiagnosis>> DiagnoseSensors(const Scenario& scenario,
                                                              const Recording& recording,
                                                              const DiagnosisTask& task) {
  std::vector<std::string> names;
  for (const ScenarioMachine& machine : scenario.machines) {
    names.push_back(NameInRecording(machine.placement.name, scenario.machines.size(), recording));
  }
  PerceptionOptions options;
  options.threads = task.threads;
  options.part.from_s = task.from_s.value_or(options.part.from_s);
  options.part.to_s = task.to_s.value_or(options.part.to_s);
  return RunPerception(scenario, names, recording, options);
}

}  // namespace

void RequireOtherTime(const Recording& one, const Recording& other) {
  const auto both = TimeInCommon(one, other);
  if (!both) return;
  throw InputError(
      other.directory().string(),
      fmt::format(
          "is of the same time as {}, from {:.3f} s to {:.3f} s of that, by the epochs of both; "
          "need recordings of different drives, since each is judged by what it has not seen",
          one.directory().string(), ToSeconds(both->first_ns), ToSeconds(both->last_ns)));
}

std::vector<Diagnosis> DiagnoseRecording(const Scenario& scenario, const Recording& recording,
                                         const DiagnosisTask& task, const FollowProgress& progress,
                                         StageClock* clock) {
  for (const std::filesystem::path& path : task.held_out) {
    RequireOtherTime(recording, Recording(path));
  }
  const DiagnosisOptions options = OptionsOf(task, scenario.seed);
  auto seen =
      clock->Time("lidars and cameras", [&] { return DiagnoseSensors(scenario, recording, task); });
  std::vector<Diagnosis> diagnoses;
  for (std::size_t m = 0; m < scenario.machines.size(); ++m) {
    const MachineCase machine(scenario, m);
    DiagnosisCase asked{.input = machine.InputOf(recording), .recording = &recording};
    asked.origin = scenario.origin;
    asked.place = KnownPlaceOf(scenario, m);
    asked.perception = std::move(seen[m]);
    if (task.simulate) asked.simulate = SimulatorOf(scenario, m);
    for (const std::filesystem::path& path : task.held_out) {
      auto further = std::make_shared<const Recording>(path);
      asked.held_out.push_back({machine.InputOf(*further), further});
    }
    diagnoses.push_back(Diagnose(std::move(asked), options, progress, clock));
  }
  return diagnoses;
}

std::string BaselinesOfRecording(const Scenario& scenario, const Recording& recording,
                                 int threads) {
  const MachineCase machine(scenario, 0);
  const DiagnosisInput input = machine.InputOf(recording);
  const BlockOptions options{.threads = threads};
  std::vector<ReplayBlock> replayed = BlocksOf(input, MeasurementsOf(input, recording), options);
  ExcludeLaggingSamples(&replayed);
  Json json = {{"as_it_is", Json::object()}, {"methods", Json::array()}};
  Json& methods = json["methods"];
  for (const ReplayBlock& block : replayed) {
    const Stream stream = StreamOf(block, scenario.seed);
    Put(block, RmseAsItIs(block, stream), &json["as_it_is"]);
    const std::vector<BaselineAnswer> answers = BaselinesOf(block, threads, stream);
    for (std::size_t m = 0; m < answers.size(); ++m) {
      if (methods.size() <= m) {
        methods.push_back({{"method", answers[m].method},
                           {"gives_findings", answers[m].gives_findings},
                           {"gives_names", answers[m].gives_names},
                           {"found", false},
                           {"names", Json::array()},
                           {"rmse", Json::object()}});
      }
      Add(block, answers[m], &methods[m]);
    }
  }
  return json.dump(2) + "\n";
}

namespace {

/// Throws InputError if two paths are the same folder.
void RequireDifferent(const std::vector<std::filesystem::path>& paths) {
  for (std::size_t i = 0; i < paths.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      std::error_code none;
      if (!std::filesystem::equivalent(paths[i], paths[j], none)) continue;
      throw InputError(paths[i].string(), {FaultKind::kRepeated,
                                           "is named twice; need different recordings, since each "
                                           "is judged by those that it has not seen"});
    }
  }
}

}  // namespace

std::vector<DiagnosedRecording> DiagnoseRecordings(
    const Scenario& scenario, const std::vector<std::filesystem::path>& recordings,
    const DiagnosisTask& task, const FollowProgress& progress, StageClock* clock) {
  RequireDifferent(recordings);
  std::vector<Recording> opened;
  for (const std::filesystem::path& path : recordings) {
    opened.emplace_back(path);
    for (std::size_t r = 0; r + 1 < opened.size(); ++r) RequireOtherTime(opened[r], opened.back());
  }
  std::vector<DiagnosedRecording> diagnosed;
  for (std::size_t r = 0; r < recordings.size(); ++r) {
    DiagnosisTask one = task;
    for (std::size_t other = 0; other < recordings.size(); ++other) {
      if (other != r) one.held_out.push_back(recordings[other]);
    }
    diagnosed.push_back(
        {recordings[r], DiagnoseRecording(scenario, opened[r], one, progress, clock)});
  }
  return diagnosed;
}

std::vector<const Diagnosis*> OfMachine(const std::vector<DiagnosedRecording>& recordings,
                                        std::size_t machine) {
  std::vector<const Diagnosis*> diagnoses;
  for (const DiagnosedRecording& one : recordings) diagnoses.push_back(&one.machines[machine]);
  return diagnoses;
}

}  // namespace tera
