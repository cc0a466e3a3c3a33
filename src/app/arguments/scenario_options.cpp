#include "app/arguments/scenario_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <thread>

#include "app/arguments/argument_checks.h"

namespace tera {

HostOptions::HostOptions()
    : threads(static_cast<int>(std::max(1u, std::thread::hardware_concurrency()))) {}

void AddScenarioOptions(CLI::App* command, ScenarioOptions* options) {
  command->add_option("SCENARIO", options->scenario, "Scenario file (YAML)")->required();
  command->add_option("--seed", options->seed, "Seed, instead of the scenario's")
      ->check(WholeNumberFrom0());
  command
      ->add_option("--set", options->set,
                   "key.path=value instead of the scenario's; may be repeated")
      ->take_all();
  command
      ->add_option("--effects", options->effects,
                   "File with effects that override the scenario's; may be repeated")
      ->take_all();
  command->add_flag("--without-meshes", options->without_meshes, "Skip missing meshes of a URDF");
  command
      ->add_option("--episode", options->episode,
                   "Number of the draw of the scenario's randomise: (0)")
      ->check(WholeNumberFrom0());
}

void AddHostOptions(CLI::App* command, HostOptions* options) {
  command->add_option("--threads", options->threads, "Threads for rays and encoding")
      ->check(WholeNumberBetween(1, 256));
  command
      ->add_option("--egl-device", options->egl.device,
                   "GPU to render with; without it the first GPU, else Mesa in software")
      ->check(WholeNumberFrom0());
}

LoadedScenario Load(const ScenarioOptions& options, const std::vector<std::string>& overrides) {
  std::vector<std::string> all = options.set;
  if (options.seed) all.push_back(fmt::format("seed={}", *options.seed));
  if (options.without_meshes) all.push_back("without_meshes=true");
  all.insert(all.end(), overrides.begin(), overrides.end());
  return LoadScenario(options.scenario, all, options.effects, {}, options.episode);
}

}  // namespace tera
