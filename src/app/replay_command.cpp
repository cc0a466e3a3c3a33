#include <filesystem>
#include <memory>
#include <utility>

#include "app/commands.h"
#include "app/followed_run.h"
#include "app/load_scenario.h"
#include "sim/replay.h"

namespace tera {
namespace {

struct Arguments {
  std::filesystem::path recording;
  GenerateOptions options;
};

void RunReplay(const Arguments& arguments) {
  const Recording recording(arguments.recording);
  RequireSimulated(recording);
  LoadedScenario loaded = LoadScenario(arguments.recording / "scenario.yaml", {});
  CommandAsRecorded(recording, &loaded.scenario);
  loaded.resolved_yaml = recording.info().resolved_scenario_yaml;
  FollowRun(std::move(loaded), arguments.options);
}

}  // namespace

void AddReplayCommand(CLI::App* app) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app->add_subcommand(
      "replay", "Simulate a recorded run again from its commands, to the same bytes");
  command->add_option("RECORDING", arguments->recording, "Directory of a simulated dataset")
      ->required();
  AddRunOptions(command, &arguments->options);
  command->callback([arguments] { RunReplay(*arguments); });
}

}  // namespace tera
