#include "app/progress/followed_run.h"

#include <fmt/format.h>
#include <unistd.h>

#include <csignal>
#include <string>
#include <utility>

#include "app/progress/progress_bar.h"

namespace tera {
namespace {

/// During its lifetime, SIGINT and SIGTERM print `text`, which explains how to resume, and then end
/// the program. Only one instance may exist.
class StopMessage {
 public:
  explicit StopMessage(const std::string& text);
  StopMessage(const StopMessage&) = delete;
  StopMessage& operator=(const StopMessage&) = delete;
  ~StopMessage();
};

std::string message;

/// Signal handler, which may call only async-signal-safe functions. SA_RESETHAND has restored the
/// default action, so the raised signal ends the program after the handler returns.
void SayAndEnd(int signal) {
  // A failed write is ignored, because the program ends here.
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, message.data(), message.size());
  raise(signal);
}

StopMessage::StopMessage(const std::string& text) {
  message = text;
  struct sigaction action = {};
  action.sa_handler = SayAndEnd;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

StopMessage::~StopMessage() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

constexpr double kPipeLine_s = 10;  ///< interval between progress lines if the output is not a
                                    ///< terminal
constexpr double kShown_s = 0.005;  ///< shorter times would be shown as 0.00, for stages that the
                                    ///< run does not have

void PrintReport(const GenerateReport& report, const std::string& out) {
  const auto factor = [&](double wall_s) {
    return wall_s >= kShown_s ? fmt::format("{:8.1f} x", report.simulated_s / wall_s) : "       -";
  };
  fmt::print("{}: {:.1f} s simulated in {:.1f} s, {} frames, {:.1f} MB\n", out, report.simulated_s,
             report.wall_s, report.frames, 1e-6 * static_cast<double>(report.bytes));
  const double measured_s =
      report.physics_s + report.soil_s + report.camera_wait_s + report.lidar_s;
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
  if (!report.task) return;
  fmt::print(
      "  task {}: {:.1f} % of the floor within tolerance, {:.3f} to {:.3f} m, rms {:.3f} m; "
      "to cut {:.3f} m3, cut beyond {:.3f} m3\n",
      report.task_done ? "done" : "not done", 100 * report.task->within, report.task->lowest_m,
      report.task->highest_m, report.task->rms_m, report.task->to_cut_m3,
      report.task->cut_beyond_m3);
}

/// Executes the run and ends the progress line.
GenerateReport RunWithProgress(const DatasetRun& run, const RunOptions& options) {
  ProgressBar bar(kPipeLine_s);
  const StopMessage on_stop(
      fmt::format("\nstopped; the same command with --resume finishes {}\n", options.out.string()));
  return run({.out = options.out,
              .threads = options.host.threads,
              .resume = options.resume,
              .keep_state = options.keep_state,
              .egl = options.host.egl,
              .progress = [&](const GenerateProgress& progress) { bar.Show(progress); }});
}

}  // namespace

void AddRunOptions(CLI::App* command, RunOptions* options) {
  command->add_option("--out", options->out, "Directory of the dataset; new or empty")->required();
  AddHostOptions(command, &options->host);
  command->add_flag("--resume", options->resume, "Finish an interrupted run");
}

void FollowRun(const DatasetRun& run, const RunOptions& options) {
  PrintReport(RunWithProgress(run, options), options.out.string());
}

void FollowRun(const LoadedScenario& loaded, const RunOptions& options) {
  FollowRun(
      [&](const GenerateOptions& run) {
        return Generate(loaded.scenario, loaded.resolved_yaml, run);
      },
      options);
}

}  // namespace tera
