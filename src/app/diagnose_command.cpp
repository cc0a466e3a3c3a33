#include <memory>

#include "app/arguments/argument_checks.h"
#include "app/commands.h"
#include "app/diagnosed_report.h"

namespace tera {

void AddDiagnoseCommand(CLI::App* app) {
  auto arguments = std::make_shared<DiagnoseArguments>();
  CLI::App* command =
      app->add_subcommand("diagnose", "Find why a recording differs from its simulation");
  AddScenarioOptions(command, &arguments->scenario);
  command
      ->add_option("RECORDING", arguments->recordings,
                   "Dataset, simulated or imported; several datasets give their shared effects")
      ->required();
  command->add_option("--out", arguments->out, "Folder to write, which must not exist")->required();
  command
      ->add_option("--from", arguments->task.from_s,
                   "Seconds of the recording to skip at its start")
      ->check(CLI::Range(0.0, 1e6));
  command->add_option("--to", arguments->task.to_s, "Seconds of the recording at which to stop")
      ->check(CLI::Range(0.0, 1e6));
  command
      ->add_option("--held-out", arguments->task.held_out,
                   "Further recording that tests the diagnosis; may be repeated")
      ->take_all()
      ->allow_extra_args(false);
  command->add_option("--library", arguments->library,
                      "File (YAML) that limits or extends the candidate mechanisms");
  command
      ->add_option("--time-limit", arguments->task.time_limit_s,
                   "Seconds after which the search stops and reports its state")
      ->check(PositiveNumber("seconds"));
  command->add_flag_callback(
      "--no-simulation", [arguments] { arguments->task.simulate = false; },
      "Skip the whole simulation that confirms the diagnosis");
  command->add_option("--threads", arguments->task.threads, "Fits at a time")
      ->check(WholeNumberBetween(1, 1024));
  command->add_flag("--profile", arguments->profile, "Print the time of each step");
  command->callback([arguments] { ReportDiagnosis(*arguments); });
}

}  // namespace tera
