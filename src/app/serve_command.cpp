#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <optional>
#include <string>

#include "app/about/version.h"
#include "app/arguments/argument_checks.h"
#include "app/arguments/scenario_options.h"
#include "app/commands.h"
#include "app/progress/stop_signals.h"
#include "serve/live_stage.h"
#include "serve/scenario_source.h"
#include "serve/server.h"

namespace tera {
namespace {

struct ServeArguments {
  ScenarioOptions scenario;
  HostOptions host;
  ServerOptions server{.port = 50051, .name = std::string("tera ") + kVersion};
  std::optional<std::string> record;
  bool stop_with_stdin = false;
};

void RunServe(const ServeArguments& arguments) {
  const ScenarioSource source =
      SourceOf([options = arguments.scenario](std::optional<std::uint64_t> seed) {
        ScenarioOptions seeded = options;
        if (seed) seeded.seed = seed;
        return Load(seeded);
      });
  const std::shared_ptr<const Scenario> scenario = source(std::nullopt).scenario;
  StageOptions options{
      .threads = arguments.host.threads, .egl = arguments.host.egl, .record = std::nullopt};
  if (arguments.record) options.record = *arguments.record;
  const Server::Log log = [](const std::string& line) { fmt::print(stderr, "{}\n", line); };
  const StopSignals stop;
  const Server server(arguments.server, LiveStages(*scenario, source, options, log), log);
  fmt::print("serving {} on {}\n", scenario->name, server.address());
  std::fflush(stdout);
  stop.Wait(arguments.stop_with_stdin);
}

}  // namespace

void AddServeCommand(CLI::App* app) {
  auto arguments = std::make_shared<ServeArguments>();
  CLI::App* command = app->add_subcommand(
      "serve",
      "Let a program step a scenario over a socket, until Ctrl-C (docs/reference/serve.md)");
  AddScenarioOptions(command, &arguments->scenario);
  command->add_option("--port", arguments->server.port, "Port; 0 lets the system choose")
      ->check(WholeNumberBetween(0, 65535))
      ->capture_default_str();
  command
      ->add_option("--listen", arguments->server.address,
                   "Address to listen on. Everyone who reaches it can use the server, which has no "
                   "password and no encryption")
      ->capture_default_str();
  command->add_option("--record", arguments->record,
                      "Folder for one dataset per episode, episode_0001 and so on");
  command->add_flag(
      "--stop-with-stdin", arguments->stop_with_stdin,
      "Also end when standard input closes, for instance when the parent program dies");
  AddHostOptions(command, &arguments->host);
  command->callback([arguments] { RunServe(*arguments); });
}

}  // namespace tera
