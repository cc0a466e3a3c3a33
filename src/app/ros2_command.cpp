#include <fmt/format.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "app/arguments/argument_checks.h"
#include "app/arguments/scenario_options.h"
#include "app/commands.h"
#include "core/error.h"
#include "core/parse_number.h"
#include "ros2/live.h"

namespace tera {
namespace {

struct Ros2Arguments {
  ScenarioOptions scenario;
  HostOptions host;
  std::optional<int> domain_id;
  std::optional<std::string> record;
  bool localhost_only = false;
  ros::LiveRosOptions options;
};

/// During its lifetime, the first SIGINT and the first SIGTERM only request a stop. A second signal
/// of the same kind ends the program.
class StopRequest {
 public:
  StopRequest() {
    struct sigaction action = {};
    action.sa_handler = [](int) { asked = 1; };
    action.sa_flags = static_cast<int>(SA_RESETHAND);
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
  }
  StopRequest(const StopRequest&) = delete;
  StopRequest& operator=(const StopRequest&) = delete;
  ~StopRequest() {
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
  }
  static bool Asked() { return asked != 0; }

 private:
  static inline volatile std::sig_atomic_t asked = 0;
};

std::string_view Environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

/// Default domain of ROS 2: ROS_DOMAIN_ID, or 0 if it is not set.
int DomainOfEnvironment() {
  const std::string_view text = Environment("ROS_DOMAIN_ID");
  if (text.empty()) return 0;
  const auto id = ParseNumber<int>(text);
  if (id && *id >= 0 && *id <= ros::Participant::kLargestDomainId) return *id;
  throw InputError(
      "", {FaultKind::kMistyped,
           fmt::format("ROS_DOMAIN_ID is '{}'; need a whole number from 0 to {}, or unset", text,
                       ros::Participant::kLargestDomainId)});
}

bool LocalhostOnlyByEnvironment() {
  return Environment("ROS_LOCALHOST_ONLY") == "1" ||
         Environment("ROS_AUTOMATIC_DISCOVERY_RANGE") == "LOCALHOST";
}

void PrintReport(const ros::LiveRosReport& report) {
  fmt::print(
      "{:g} s simulated in {:.2f} s; {} messages published, {} dropped; {} lever messages "
      "taken, {} refused",
      report.simulated_s, report.wall_s, report.published, report.dropped, report.levers_received,
      report.levers_refused);
  if (report.levers_unasked > 0) fmt::print(", {} not asked for", report.levers_unasked);
  if (report.timeouts > 0) fmt::print("; {} answers did not come in time", report.timeouts);
  fmt::print("\n");
}

void RunRos2(const Ros2Arguments& arguments) {
  LoadedScenario loaded = Load(arguments.scenario);

  ros::LiveRosOptions options = arguments.options;
  options.dds.domain_id = arguments.domain_id ? *arguments.domain_id : DomainOfEnvironment();
  options.dds.this_host_only = arguments.localhost_only || LocalhostOnlyByEnvironment();
  options.live.threads = arguments.host.threads;
  options.live.egl = arguments.host.egl;
  if (arguments.record) options.live.record = *arguments.record;
  options.stop = &StopRequest::Asked;
  options.log = [](const std::string& line) { fmt::print(stderr, "{}\n", line); };
  options.started = [name = loaded.scenario.name, dds = options.dds] {
    fmt::print("{} for ROS 2 on domain {}{}\n", name, dds.domain_id,
               dds.this_host_only ? ", this host only" : "");
    std::fflush(stdout);
  };

  const StopRequest stop;
  PrintReport(ros::RunForRos(std::make_shared<const Scenario>(std::move(loaded.scenario)),
                             loaded.resolved_yaml, options));
}

/// Adds options for the ratio of simulated time to wall time.
void AddPaceOptions(CLI::App* command, ros::LiveRosOptions* options) {
  command
      ->add_option("--pace", options->pace,
                   "real: wall clock; fast: as fast as possible; lockstep: one step per answer of "
                   "lever messages to /clock")
      ->transform(OneOf<ros::Pace>({{"real", ros::Pace::kReal},
                                    {"fast", ros::Pace::kFast},
                                    {"lockstep", ros::Pace::kLockstep}}));
  command
      ->add_option("--rate", options->rate_hz,
                   "Rate in Hz of /clock, of the states, and of polling for lever messages")
      ->check(NumberBetween(1, 1e4, "Hz"))
      ->capture_default_str();
  command
      ->add_option("--answer-timeout", options->answer_timeout_s,
                   "Wall-clock seconds that lockstep waits for an answer")
      ->check(NumberBetween(0.01, 3600, "seconds"))
      ->capture_default_str();
  command->add_option("--duration", options->duration_s, "Simulated seconds; without it no end")
      ->check(PositiveNumber("seconds"));
}

}  // namespace

void AddRos2Command(CLI::App* app) {
  auto arguments = std::make_shared<Ros2Arguments>();
  CLI::App* command = app->add_subcommand(
      "ros2", "Run a scenario live for ROS 2, until Ctrl-C (docs/reference/ros2.md)");
  AddScenarioOptions(command, &arguments->scenario);
  command->add_option("--domain", arguments->domain_id, "DDS domain; else ROS_DOMAIN_ID, else 0")
      ->check(WholeNumberBetween(0, ros::Participant::kLargestDomainId));
  command->add_flag("--localhost-only", arguments->localhost_only,
                    "Stay on this host, as with ROS_LOCALHOST_ONLY=1; without it everyone on the "
                    "network can drive the machines");
  AddPaceOptions(command, &arguments->options);
  command->add_option("--record", arguments->record,
                      "Also write a dataset to this directory; new or empty");
  AddHostOptions(command, &arguments->host);
  command->callback([arguments] { RunRos2(*arguments); });
}

}  // namespace tera
