#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <utility>

#include "app/commands.h"
#include "app/followed_run.h"
#include "app/load_scenario.h"
#include "core/error.h"
#include "dataset/checked_file.h"
#include "dataset/writer.h"
#include "sim/replay.h"

namespace tera {
namespace {

struct Arguments {
  std::filesystem::path recording;
  RunOptions options;
};

LoadedScenario Replayed(const std::filesystem::path& directory) {
  const std::filesystem::path scenario_file = directory / "scenario.yaml";
  LoadedScenario loaded;
  if (WasStopped(directory)) {
    loaded = LoadScenario(scenario_file, {});
    CommandAsFarAsRecorded(directory, &loaded.scenario);
  } else {
    const Recording recording(directory);
    RequireSimulated(recording);
    loaded = LoadScenario(scenario_file, {});
    CommandAsRecorded(recording, &loaded.scenario);
  }
  loaded.resolved_yaml = ReadWholeFile(scenario_file);
  return loaded;
}

/// What is replayed must outlast it: it may be all that is left of the run.
void RequireAnotherPlace(const std::filesystem::path& recording, const std::filesystem::path& out) {
  for (const std::filesystem::path& written : {out, IncompleteOf(out)}) {
    std::error_code ignored;
    if (!std::filesystem::equivalent(recording, written, ignored)) continue;
    throw InputError(
        fmt::format("--out {}: would be written to {}, which is the recording to be replayed; give "
                    "it another name",
                    out.string(), written.string()));
  }
}

void RunReplay(const Arguments& arguments) {
  RequireAnotherPlace(arguments.recording, arguments.options.out);
  FollowRun(Replayed(arguments.recording), arguments.options);
}

}  // namespace

void AddReplayCommand(CLI::App* app) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app->add_subcommand(
      "replay", "Simulate a recorded run again from its commands, to the same bytes");
  command
      ->add_option("RECORDING", arguments->recording,
                   "Directory of a simulated dataset; also one that was stopped (.incomplete)")
      ->required();
  AddRunOptions(command, &arguments->options);
  command->callback([arguments] { RunReplay(*arguments); });
}

}  // namespace tera
