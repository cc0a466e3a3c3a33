#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/arguments/argument_checks.h"
#include "app/arguments/scenario_options.h"
#include "app/commands.h"
#include "campaign/engines/pool.h"
#include "campaign/merge/distributions.h"
#include "campaign/merge/merge.h"
#include "campaign/plan/plan.h"
#include "campaign/work/index.h"
#include "campaign/work/worker.h"

namespace tera {
namespace {

constexpr int kNotAllDone = 1;
constexpr int kEpisodesPerLine = 100;

std::string DurationText(double seconds) {
  const auto whole_s = static_cast<std::int64_t>(seconds + 0.5);
  return fmt::format("{}:{:02}:{:02}", whole_s / 3600, whole_s / 60 % 60, whole_s % 60);
}

void ShowProgress(const PoolProgress& progress) {
  fmt::print(stderr, "{} of {} done, {} failed, {} running, {} so far{}\n", progress.done,
             progress.episodes, progress.failed, progress.running, DurationText(progress.wall_s),
             progress.left_s > 0 ? ", about " + DurationText(progress.left_s) + " left" : "");
}

/// Prints the state; status 1 unless all episodes are there.
void PrintState(const Plan& plan, const CampaignState& state) {
  fmt::print("{}", StatusText(plan, state));
  if (!state.failed.empty() || !state.missing.empty()) throw CLI::RuntimeError(kNotAllDone);
}

struct RunArguments {
  std::filesystem::path folder;
  std::optional<int> index;
  std::optional<int> processes;
  int threads = 1;
  EglOptions egl;
};

void RunRun(const RunArguments& arguments) {
  const Plan plan = LoadPlan(arguments.folder);
  if (arguments.index) {
    return RunEpisode(plan, *arguments.index, {arguments.threads, arguments.egl});
  }
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe");
  std::vector<std::string> further = {"--threads", std::to_string(arguments.threads)};
  if (arguments.egl.device >= 0) {
    further.emplace_back("--egl-device");
    further.push_back(std::to_string(arguments.egl.device));
  }
  const int fill = std::max(1, HostOptions().threads / arguments.threads);
  PrintState(plan, RunPool(plan, {.program = program,
                                  .processes = arguments.processes.value_or(fill),
                                  .arguments = further,
                                  .progress = ShowProgress}));
}

void AddFolder(CLI::App* command, std::filesystem::path* folder) {
  command->add_option("DIR", *folder, "Folder of a planned campaign")->required();
}

void AddPlanVerb(CLI::App* app) {
  struct Arguments {
    std::filesystem::path campaign, out;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app->add_subcommand("plan", "Check a campaign and write its plan");
  command->add_option("CAMPAIGN", arguments->campaign, "Campaign file (YAML)")->required();
  command->add_option("--out", arguments->out, "Folder of the campaign")->required();
  command->callback([arguments] {
    const Plan plan = MakePlan(arguments->campaign, arguments->out);
    fmt::print("{}: {} episodes planned in {}\n", plan.campaign.name, plan.campaign.episodes,
               arguments->out.string());
  });
}

void AddRunVerb(CLI::App* app) {
  auto arguments = std::make_shared<RunArguments>();
  CLI::App* command = app->add_subcommand("run", "Make the episodes that are missing");
  AddFolder(command, &arguments->folder);
  command->add_option("--index", arguments->index, "Make this episode alone, in this process")
      ->check(WholeNumberFrom0());
  command
      ->add_option("--processes", arguments->processes,
                   "Most episodes at once; as many as there are cores")
      ->check(WholeNumberBetween(1, 4096));
  command->add_option("--threads", arguments->threads, "Threads of each episode (1)")
      ->check(WholeNumberBetween(1, 256));
  command->add_option("--egl-device", arguments->egl.device, "GPU to render with, as for generate")
      ->check(WholeNumberFrom0());
  command->callback([arguments] { RunRun(*arguments); });
}

void AddStatusVerb(CLI::App* app) {
  auto folder = std::make_shared<std::filesystem::path>();
  CLI::App* command =
      app->add_subcommand("status", "What is done; status 1 unless all is, brings the index up");
  AddFolder(command, folder.get());
  command->callback([folder] {
    const Plan plan = LoadPlan(*folder);
    PrintState(plan, RefreshIndex(plan));
  });
}

void AddRetryVerb(CLI::App* app) {
  struct Arguments {
    std::filesystem::path folder;
    bool all = false;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app->add_subcommand("retry", "Let `run` try failed episodes again");
  AddFolder(command, &arguments->folder);
  command->add_flag("--all", arguments->all,
                    "Also those that failed by bad input, refusals or a bug");
  command->callback([arguments] {
    const int cleared = ClearFailures(LoadPlan(arguments->folder), arguments->all);
    fmt::print("{} episodes are tried again by `tera campaign run`\n", cleared);
  });
}

void AddMergeVerb(CLI::App* app) {
  struct Arguments {
    std::filesystem::path folder;
    MergeOptions options;
  };
  constexpr int kMostSpread = 1'000'000;
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app->add_subcommand("merge", "Make one dataset of all episodes");
  AddFolder(command, &arguments->folder);
  command->add_option("--out", arguments->options.out, "Folder of the dataset; new or empty")
      ->required();
  command
      ->add_option("--sample", arguments->options.every_frame,
                   "Lint opens one of so many frames of each camera and lidar (10)")
      ->check(WholeNumberBetween(1, kMostSpread));
  command->callback([arguments] {
    MergeOptions& options = arguments->options;
    options.out = std::filesystem::absolute(options.out);
    options.progress = [](int done, int episodes) {
      if (done == episodes || done % kEpisodesPerLine == 0) {
        fmt::print(stderr, "{} of {} episodes checked\n", done, episodes);
      }
    };
    const MergeReport report = Merge(LoadPlan(arguments->folder), options);
    fmt::print("{}: {} episodes, {} archives, {:.1f} MB; {} failed episodes left out\n",
               options.out.string(), report.episodes, report.archives,
               1e-6 * static_cast<double>(report.bytes), report.left_out);
    for (const auto& [part, count] : report.of_part) {
      if (!part.empty()) fmt::print("  {}: {} episodes\n", part, count);
    }
  });
}

void AddReportVerb(CLI::App* app) {
  auto folder = std::make_shared<std::filesystem::path>();
  CLI::App* command =
      app->add_subcommand("report", "Values, refusals and cost of the episodes, as Markdown");
  AddFolder(command, folder.get());
  command->callback([folder] {
    const Plan plan = LoadPlan(*folder);
    fmt::print("{}", CampaignReport(plan, RefreshIndex(plan)));
  });
}

}  // namespace

void AddCampaignCommand(CLI::App* app) {
  CLI::App* command = app->add_subcommand("campaign", "Many varied episodes of one scenario");
  command->require_subcommand(1);
  AddPlanVerb(command);
  AddRunVerb(command);
  AddStatusVerb(command);
  AddRetryVerb(command);
  AddMergeVerb(command);
  AddReportVerb(command);
}

}  // namespace tera
