#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/arguments/argument_checks.h"
#include "app/arguments/scenario_options.h"
#include "app/commands.h"
#include "campaign/engines/emitters.h"
#include "campaign/engines/pool.h"
#include "campaign/engines/slurm.h"
#include "campaign/merge/distributions.h"
#include "campaign/merge/merge.h"
#include "campaign/plan/plan.h"
#include "campaign/work/index.h"
#include "campaign/work/worker.h"
#include "core/error.h"
#include "dataset/files/checked_file.h"

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

/// Prints the state. Exits with status 1 unless all episodes are complete.
void PrintState(const Plan& plan, const CampaignState& state) {
  fmt::print("{}", StatusText(plan, state));
  if (!state.failed.empty() || !state.missing.empty()) throw CLI::RuntimeError(kNotAllDone);
}

enum class Engine { kPool, kSlurm, kSsh, kKubernetes, kOneEpisode };

std::string EngineName(Engine engine) {
  switch (engine) {
    case Engine::kPool:
      return "a run on this computer";
    case Engine::kSlurm:
      return "--on slurm";
    case Engine::kSsh:
      return "--on ssh";
    case Engine::kKubernetes:
      return "--on kubernetes";
    case Engine::kOneEpisode:
      return "--index";
  }
  return "";
}

/// An option that only some engines support.
struct EngineOption {
  CLI::Option* option = nullptr;
  std::vector<Engine> engines;
};

struct RunArguments {
  std::filesystem::path folder;
  std::optional<int> index;
  std::optional<int> processes;
  int threads = 1, memory_mb = 0;
  EglOptions egl;
  Engine engine = Engine::kPool;
  std::filesystem::path hosts;
  SlurmOptions slurm;
  std::string image, volume;  ///< the volume has the form CLAIM:PATH
  std::vector<EngineOption> of_engines;
};

void RequireOwnOptions(const RunArguments& arguments, Engine engine) {
  std::vector<InputFault> faults;
  for (const EngineOption& own : arguments.of_engines) {
    if (own.option->count() == 0 || std::ranges::count(own.engines, engine) > 0) continue;
    std::vector<std::string> names;
    for (const Engine other : own.engines) names.push_back(EngineName(other));
    faults.emplace_back(FaultKind::kInconsistent,
                        fmt::format("is an option of {}, not of {}; remove it",
                                    fmt::join(names, ", "), EngineName(engine)),
                        own.option->get_name());
  }
  if (!faults.empty()) throw InputError(std::move(faults));
}

WorkerCommand WorkerOf(const RunArguments& arguments) {
  WorkerCommand worker{std::filesystem::read_symlink("/proc/self/exe"),
                       {"--threads", std::to_string(arguments.threads)}};
  if (arguments.egl.device >= 0) {
    worker.arguments.emplace_back("--egl-device");
    worker.arguments.push_back(std::to_string(arguments.egl.device));
  }
  return worker;
}

void RunSlurm(const Plan& plan, const RunArguments& arguments) {
  SlurmOptions slurm = arguments.slurm;
  slurm.worker = WorkerOf(arguments);
  slurm.memory_mb = arguments.memory_mb;
  slurm.say = [](const std::string& text) { fmt::print(stderr, "{}\n", text); };
  slurm.arguments = fmt::format("--cpus-per-task={} {}", arguments.threads, slurm.arguments);
  PrintState(plan, RunOnSlurm(plan, slurm));
}

void WriteKubernetesJob(const Plan& plan, const RunArguments& arguments) {
  const std::size_t colon = arguments.volume.find(':');
  if (arguments.image.empty() || colon == std::string::npos) {
    throw InputError("--on kubernetes",
                     {FaultKind::kMissing,
                      "need --image IMAGE and --volume CLAIM:PATH, a PersistentVolumeClaim and the "
                      "path of this folder in it"});
  }
  constexpr int kPodsAtOnce = 32;
  const std::filesystem::path file = plan.folder / "kubernetes.yaml";
  WorkerCommand worker = WorkerOf(arguments);
  worker.program = "tera";
  WriteWholeFile(file, KubernetesJob(plan, {.worker = worker,
                                            .image = arguments.image,
                                            .claim = arguments.volume.substr(0, colon),
                                            .mounted_at = arguments.volume.substr(colon + 1),
                                            .parallel = arguments.processes.value_or(kPodsAtOnce),
                                            .memory_mb = arguments.memory_mb}));
  fmt::print("{}: start it by `kubectl create -f`; `tera campaign status` prints the progress\n",
             file.string());
}

void RunRun(const RunArguments& arguments) {
  RequireOwnOptions(arguments, arguments.index ? Engine::kOneEpisode : arguments.engine);
  const Plan plan = LoadPlan(arguments.folder);
  if (arguments.index) {
    if (!RunEpisode(plan, *arguments.index, {arguments.threads, arguments.egl})) {
      fmt::print(stderr, "episode {}: another worker is making it\n", *arguments.index);
    }
    return;
  }
  switch (arguments.engine) {
    case Engine::kSlurm:
      return RunSlurm(plan, arguments);
    case Engine::kSsh:
      if (arguments.hosts.empty()) {
        throw InputError("--on ssh",
                         {FaultKind::kMissing, "need --hosts FILE with one host a line"});
      }
      return PrintState(plan, RunOverSsh(plan, {.worker = WorkerOf(arguments),
                                                .hosts = arguments.hosts,
                                                .processes = arguments.processes}));
    case Engine::kKubernetes:
      return WriteKubernetesJob(plan, arguments);
    case Engine::kPool:
    case Engine::kOneEpisode:
      break;
  }
  const int fill = std::max(1, HostOptions().threads / arguments.threads);
  PrintState(plan, RunPool(plan, {.worker = WorkerOf(arguments),
                                  .processes = arguments.processes.value_or(fill),
                                  .progress = ShowProgress}));
}

void AddEngineOptions(CLI::App* command, RunArguments* arguments) {
  constexpr int kMost = 10'000'000;
  SlurmOptions* const slurm = &arguments->slurm;
  const auto of = [&](std::vector<Engine> engines, CLI::Option* option) {
    arguments->of_engines.push_back({option, std::move(engines)});
    return option;
  };
  of({Engine::kSlurm, Engine::kSsh, Engine::kKubernetes},
     command->add_option("--on", arguments->engine,
                         "slurm: by job arrays; ssh: by GNU parallel; kubernetes: write an "
                         "indexed Job"))
      ->transform(OneOf<Engine>(
          {{"slurm", Engine::kSlurm}, {"ssh", Engine::kSsh}, {"kubernetes", Engine::kKubernetes}}));
  of({Engine::kPool, Engine::kSsh, Engine::kKubernetes},
     command->add_option("--processes", arguments->processes,
                         "Most episodes at once; number of cores"))
      ->check(WholeNumberBetween(1, 4096));
  of({Engine::kSlurm, Engine::kKubernetes},
     command->add_option("--memory-mb", arguments->memory_mb,
                         "slurm, kubernetes: memory of a task"))
      ->check(WholeNumberBetween(1, kMost));
  of({Engine::kSlurm}, command->add_option("--per-task", slurm->per_task,
                                           "slurm: episodes of a task (5 min of them)"))
      ->check(WholeNumberBetween(1, kMost));
  of({Engine::kSlurm},
     command->add_option("--minutes", slurm->minutes, "slurm: time limit of a task"))
      ->check(WholeNumberBetween(1, kMost));
  of({Engine::kSlurm}, command->add_option("--tries", slurm->tries,
                                           "slurm: most arrays in a row without an episode (3)"))
      ->check(WholeNumberBetween(1, 100));
  of({Engine::kSlurm},
     command->add_option("--poll", slurm->poll_s, "slurm: seconds between status queries (30)"))
      ->check(PositiveNumber("seconds"));
  of({Engine::kSlurm},
     command->add_option("--sbatch", slurm->arguments,
                         "slurm: further options of sbatch, \"--partition=sim --qos=low\""));
  of({Engine::kSsh}, command->add_option("--hosts", arguments->hosts,
                                         "ssh: file of hosts, as --sshloginfile has it"))
      ->check(CLI::ExistingFile);
  of({Engine::kKubernetes}, command->add_option("--image", arguments->image,
                                                "kubernetes: image of a container with tera"));
  of({Engine::kKubernetes},
     command->add_option("--volume", arguments->volume,
                         "kubernetes: CLAIM:PATH, the shared volume that holds DIR"));
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
  command->add_option("--index", arguments->index, "Make only this episode, in this process")
      ->check(WholeNumberFrom0());
  command->add_option("--threads", arguments->threads, "Threads of each episode (1)")
      ->check(WholeNumberBetween(1, 256));
  command->add_option("--egl-device", arguments->egl.device, "GPU to render with, as for generate")
      ->check(WholeNumberFrom0());
  AddEngineOptions(command, arguments.get());
  command->callback([arguments] { RunRun(*arguments); });
}

void AddStatusVerb(CLI::App* app) {
  auto folder = std::make_shared<std::filesystem::path>();
  CLI::App* command = app->add_subcommand(
      "status", "Print the progress and update the index; status 1 unless all is done");
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
  CLI::App* command = app->add_subcommand("retry", "Allow `run` to retry failed episodes");
  AddFolder(command, &arguments->folder);
  command->add_flag("--all", arguments->all,
                    "Also episodes that failed by bad input, refusals or a bug");
  command->callback([arguments] {
    const int cleared = ClearFailures(LoadPlan(arguments->folder), arguments->all);
    fmt::print("{} episodes: `tera campaign run` retries them\n", cleared);
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
                   "Lint checks one of so many frames of each camera and lidar (10)")
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
  CLI::App* command = app->add_subcommand("campaign", "Run many varied episodes of one scenario");
  command->require_subcommand(1);
  AddPlanVerb(command);
  AddRunVerb(command);
  AddStatusVerb(command);
  AddRetryVerb(command);
  AddMergeVerb(command);
  AddReportVerb(command);
}

}  // namespace tera
