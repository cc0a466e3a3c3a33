#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/arguments/argument_checks.h"
#include "app/commands.h"
#include "app/progress/followed_run.h"
#include "sim/run/recorded_run.h"

namespace tera {
namespace {

struct ReplayArguments {
  std::filesystem::path recording;
  std::vector<std::string> moved;
  RunOptions options;
};

void RunReplay(const ReplayArguments& arguments) {
  RequireAnotherPlace(arguments.recording, arguments.options.out);
  FollowRun(LoadRecordedRun(arguments.recording, arguments.moved), arguments.options);
}

}  // namespace

void AddReplayCommand(CLI::App* app) {
  auto arguments = std::make_shared<ReplayArguments>();
  CLI::App* command = app->add_subcommand(
      "replay", "Simulate a recorded run again from its commands; the result has the same bytes");
  command
      ->add_option("RECORDING", arguments->recording,
                   "Directory of a simulated dataset, also of an interrupted one (.incomplete)")
      ->required();
  AddRunOptions(command, &arguments->options);
  AddMovedOption(command, &arguments->moved);
  command->callback([arguments] { RunReplay(*arguments); });
}

}  // namespace tera
