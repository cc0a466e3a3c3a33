#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "app/commands.h"
#include "app/load_scenario.h"
#include "app/progress_bar.h"
#include "app/stop_message.h"
#include "sim/generate.h"

namespace tera {
namespace {

struct Arguments {
  std::string scenario, out;
  std::optional<std::uint64_t> seed;
  std::optional<double> duration_s;
  int threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  int egl_device = -1;
  bool resume = false;
  std::vector<std::string> set;
};

void PrintReport(const GenerateReport& report, const std::string& out) {
  const auto factor = [&](double wall_s) {
    return wall_s > 0 ? fmt::format("{:8.1f} x", report.simulated_s / wall_s) : "       -";
  };
  fmt::print("{}: {:.1f} s simulated in {:.1f} s, {} frames, {:.1f} MB\n", out, report.simulated_s,
             report.wall_s, report.frames, 1e-6 * static_cast<double>(report.bytes));
  const double measured_s = report.physics_s + report.soil_s + report.camera_s + report.lidar_s;
  fmt::print("  stage          wall s   real time\n");
  const std::pair<const char*, double> stages[] = {{"physics", report.physics_s},
                                                   {"soil", report.soil_s},
                                                   {"cameras", report.camera_s},
                                                   {"lidars", report.lidar_s},
                                                   {"everything else", report.wall_s - measured_s},
                                                   {"whole run", report.wall_s}};
  for (const auto& [name, wall_s] : stages) {
    fmt::print("  {:<14} {:7.2f}  {}\n", name, wall_s, factor(wall_s));
  }
}

/// The run, with its progress on the terminal; the line of it has ended when this returns.
GenerateReport FollowedRun(const Arguments& arguments, LoadedScenario loaded) {
  ProgressBar bar;
  GenerateOptions options;
  options.out = arguments.out;
  options.threads = arguments.threads;
  options.resume = arguments.resume;
  options.egl.device = arguments.egl_device;
  options.progress = [&](const GenerateProgress& progress) { bar.Show(progress); };
  const StopMessage on_stop(
      fmt::format("\nstopped; the same command with --resume finishes {}\n", arguments.out));
  return Generate(std::move(loaded.scenario), loaded.resolved_yaml, options);
}

void RunGenerate(const Arguments& arguments) {
  std::vector<std::string> overrides = arguments.set;
  if (arguments.seed) overrides.push_back(fmt::format("seed={}", *arguments.seed));
  if (arguments.duration_s)
    overrides.push_back(fmt::format("duration_s={}", *arguments.duration_s));
  LoadedScenario loaded = LoadScenario(arguments.scenario, overrides);

  const GenerateReport report = FollowedRun(arguments, std::move(loaded));
  if (isatty(STDOUT_FILENO) == 1) PrintReport(report, arguments.out);
}

}  // namespace

void AddGenerateCommand(CLI::App* app) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app->add_subcommand("generate", "Simulate a scenario and write its dataset");
  command->add_option("SCENARIO", arguments->scenario, "Scenario file (YAML)")->required();
  command->add_option("--out", arguments->out, "Directory of the dataset; new or empty")
      ->required();
  command->add_option("--seed", arguments->seed, "Seed, instead of the scenario's")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--duration", arguments->duration_s, "Seconds, instead of the scenario's")
      ->check(CLI::PositiveNumber);
  command->add_option("--threads", arguments->threads, "Threads for rays and encoding")
      ->check(CLI::Range(1, 256));
  command
      ->add_option("--egl-device", arguments->egl_device,
                   "GPU to render with; without it the first GPU, else Mesa in software")
      ->check(CLI::NonNegativeNumber);
  command->add_flag("--resume", arguments->resume, "Finish a run that was stopped");
  command
      ->add_option("--set", arguments->set,
                   "key.path=value instead of the scenario's; may be repeated")
      ->take_all();
  command->callback([arguments] { RunGenerate(*arguments); });
}

}  // namespace tera
