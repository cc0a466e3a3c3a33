#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "app/commands.h"
#include "app/load_scenario.h"
#include "app/version.h"
#include "serve/live_stage.h"
#include "serve/server.h"

namespace tera {
namespace {

struct Arguments {
  std::string scenario;
  ServerOptions server{.port = 50051, .name = std::string("tera ") + kVersion};
  StageOptions stage{.threads =
                         static_cast<int>(std::max(1u, std::thread::hardware_concurrency()))};
  std::optional<std::string> record;
  std::optional<std::uint64_t> seed;
  std::vector<std::string> set, effects;
};

/// Ctrl-C and SIGTERM, kept from all threads that are started while it lives and waited for by one.
class StopSignals {
 public:
  StopSignals() {
    sigemptyset(&signals_);
    sigaddset(&signals_, SIGINT);
    sigaddset(&signals_, SIGTERM);
    pthread_sigmask(SIG_BLOCK, &signals_, nullptr);
  }
  void Wait() const {
    int signal = 0;
    sigwait(&signals_, &signal);
  }

 private:
  sigset_t signals_;
};

/// The scenario as it is now, whatever becomes of its file while the server runs.
ScenarioSource SourceOf(const std::string& resolved_yaml, const std::string& name) {
  return [=](std::optional<std::uint64_t> seed) {
    std::vector<std::string> overrides;
    if (seed) overrides.push_back(fmt::format("seed={}", *seed));
    const Config config = Config::FromText(resolved_yaml, name, overrides);
    SeededScenario seeded{.scenario = ReadScenario(config.root()), .resolved_yaml = {}};
    config.Finish();
    seeded.resolved_yaml = config.ResolvedYaml();
    return seeded;
  };
}

void RunServe(const Arguments& arguments) {
  std::vector<std::string> overrides = arguments.set;
  if (arguments.seed) overrides.push_back(fmt::format("seed={}", *arguments.seed));
  const LoadedScenario loaded = LoadScenario(arguments.scenario, overrides, arguments.effects);
  StageOptions options = arguments.stage;
  if (arguments.record) options.record = *arguments.record;
  const Server::Log log = [](const std::string& line) { fmt::print(stderr, "{}\n", line); };
  const StopSignals stop;
  const Server server(
      arguments.server,
      LiveStages(loaded.scenario, SourceOf(loaded.resolved_yaml, arguments.scenario), options, log),
      log);
  fmt::print("serving {} on {}\n", loaded.scenario.name, server.address());
  std::fflush(stdout);
  stop.Wait();
}

}  // namespace

void AddServeCommand(CLI::App* app) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app->add_subcommand(
      "serve", "Let a program step a scenario over a socket, until Ctrl-C (docs/serve.md)");
  command->add_option("SCENARIO", arguments->scenario, "Scenario file (YAML)")->required();
  command->add_option("--port", arguments->server.port, "Port; 0 lets the system choose")
      ->check(CLI::Range(0, 65535))
      ->capture_default_str();
  command
      ->add_option("--listen", arguments->server.address,
                   "Address to listen on. Whoever reaches it can use the server: there is no "
                   "password and no encryption")
      ->capture_default_str();
  command->add_option("--record", arguments->record,
                      "Folder in which each episode becomes a dataset, episode_0001 and so on");
  command
      ->add_option("--seed", arguments->seed,
                   "Seed of a reset that names none, instead of the scenario's")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--threads", arguments->stage.threads, "Threads for rays and encoding")
      ->check(CLI::Range(1, 256));
  command
      ->add_option("--egl-device", arguments->stage.egl.device,
                   "GPU to render with; without it the first GPU, else Mesa in software")
      ->check(CLI::NonNegativeNumber);
  command
      ->add_option("--set", arguments->set,
                   "key.path=value instead of the scenario's; may be repeated")
      ->take_all();
  command
      ->add_option("--effects", arguments->effects,
                   "File with effects to lay over the scenario's; may be repeated")
      ->take_all();
  command->callback([arguments] { RunServe(*arguments); });
}

}  // namespace tera
