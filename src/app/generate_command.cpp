#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/arguments/argument_checks.h"
#include "app/arguments/scenario_options.h"
#include "app/commands.h"
#include "app/progress/followed_run.h"
#include "dataset/format/recorded_inputs.h"
#include "dataset/format/recording.h"
#include "dataset/format/writer.h"

namespace tera {
namespace {

struct GenerateArguments {
  ScenarioOptions scenario;
  std::optional<double> duration_s;
  RunOptions run;
};

/// Checks the inputs of a stopped run before the scenario is read, because a changed file may make
/// the scenario unreadable.
void RequireInputsOfStopped(const std::filesystem::path& out) {
  const std::filesystem::path stopped = IncompleteOf(out);
  RequireInputs(LoadInputs(stopped), {},
                fmt::format("restore that file, or delete {} to start afresh", stopped.string()));
}

void RunGenerate(const GenerateArguments& arguments) {
  if (arguments.run.resume) RequireInputsOfStopped(arguments.run.out);
  std::vector<std::string> overrides;
  if (arguments.duration_s)
    overrides.push_back(fmt::format("duration_s={}", *arguments.duration_s));
  FollowRun(Load(arguments.scenario, overrides), arguments.run);
}

}  // namespace

void AddGenerateCommand(CLI::App* app) {
  auto arguments = std::make_shared<GenerateArguments>();
  CLI::App* command = app->add_subcommand("generate", "Simulate a scenario and write its dataset");
  AddScenarioOptions(command, &arguments->scenario);
  AddRunOptions(command, &arguments->run);
  command->add_flag("--keep-state", arguments->run.keep_state,
                    "Keep the evolution of the scene, which `tera resense` and `tera layout` "
                    "measure with other sensors");
  command->add_option("--duration", arguments->duration_s, "Seconds, instead of the scenario's")
      ->check(PositiveNumber("seconds"));
  command->callback([arguments] { RunGenerate(*arguments); });
}

}  // namespace tera
