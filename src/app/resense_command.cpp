#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/arguments/argument_checks.h"
#include "app/commands.h"
#include "app/progress/followed_run.h"
#include "layout/resense.h"
#include "sim/run/recorded_run.h"

namespace tera {
namespace {

struct ResenseArguments {
  std::filesystem::path dataset;
  ResenseRig rig;
  std::vector<std::string> moved;
  RunOptions options;
};

void RunResense(const ResenseArguments& arguments) {
  RequireAnotherPlace(arguments.dataset, arguments.options.out);
  FollowRun(
      [&](const GenerateOptions& run) {
        return Resense(arguments.dataset, arguments.rig, arguments.moved, run);
      },
      arguments.options);
}

}  // namespace

void AddResenseCommand(CLI::App* app) {
  auto arguments = std::make_shared<ResenseArguments>();
  CLI::App* command = app->add_subcommand(
      "resense", "Measure a recorded scene with another rig, without simulating it again");
  command
      ->add_option("DATASET", arguments->dataset,
                   "Directory of a dataset that `tera generate --keep-state` wrote")
      ->required();
  command->add_option("RIG", arguments->rig.file, "Rig file (YAML)")->required();
  command->add_option("--machine", arguments->rig.machine,
                      "Machine that carries the rig, instead of the scenario's first");
  AddRunOptions(command, &arguments->options);
  AddMovedOption(command, &arguments->moved);
  command->callback([arguments] { RunResense(*arguments); });
}

}  // namespace tera
