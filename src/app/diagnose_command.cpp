#include <memory>

#include "app/commands.h"
#include "app/diagnose_recording.h"

namespace tera {

void AddDiagnoseCommand(CLI::App* app) {
  auto arguments = std::make_shared<DiagnoseArguments>();
  CLI::App* command = app->add_subcommand(
      "diagnose", "Say why a recording differs from the scenario that should reproduce it");
  AddScenarioOptions(command, &arguments->scenario);
  command->add_option("RECORDING", arguments->recording, "Dataset, simulated or imported")
      ->required();
  command->add_option("--out", arguments->out, "Folder to write, which must not exist")->required();
  command->add_option("--from", arguments->from_s, "Seconds of the recording to leave out first")
      ->check(CLI::Range(0.0, 1e6));
  command->add_option("--to", arguments->to_s, "Seconds of the recording at which to stop")
      ->check(CLI::Range(0.0, 1e6));
  command->add_option("--threads", arguments->threads, "Fits at a time")
      ->check(CLI::PositiveNumber);
  command->callback([arguments] { DiagnoseRecording(*arguments); });
}

}  // namespace tera
