#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/commands.h"
#include "app/followed_run.h"
#include "app/load_scenario.h"

namespace tera {
namespace {

struct Arguments {
  std::string scenario;
  std::optional<std::uint64_t> seed;
  std::optional<double> duration_s;
  std::vector<std::string> set, effects;
  GenerateOptions options;
};

void RunGenerate(const Arguments& arguments) {
  std::vector<std::string> overrides = arguments.set;
  if (arguments.seed) overrides.push_back(fmt::format("seed={}", *arguments.seed));
  if (arguments.duration_s)
    overrides.push_back(fmt::format("duration_s={}", *arguments.duration_s));
  FollowRun(LoadScenario(arguments.scenario, overrides, arguments.effects), arguments.options);
}

}  // namespace

void AddGenerateCommand(CLI::App* app) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app->add_subcommand("generate", "Simulate a scenario and write its dataset");
  command->add_option("SCENARIO", arguments->scenario, "Scenario file (YAML)")->required();
  AddRunOptions(command, &arguments->options);
  command->add_option("--seed", arguments->seed, "Seed, instead of the scenario's")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--duration", arguments->duration_s, "Seconds, instead of the scenario's")
      ->check(CLI::PositiveNumber);
  command
      ->add_option("--set", arguments->set,
                   "key.path=value instead of the scenario's; may be repeated")
      ->take_all();
  command
      ->add_option("--effects", arguments->effects,
                   "File with effects to lay over the scenario's; may be repeated")
      ->take_all();
  command->callback([arguments] { RunGenerate(*arguments); });
}

}  // namespace tera
