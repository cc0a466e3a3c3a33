#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/arguments/argument_checks.h"
#include "app/arguments/scenario_options.h"
#include "app/commands.h"
#include "campaign/engines/pool.h"
#include "campaign/plan/plan.h"
#include "campaign/sweep/sweep.h"
#include "campaign/work/index.h"
#include "core/error.h"

namespace tera {
namespace {

struct SweepArguments {
  std::filesystem::path campaign, out;
  int processes = HostOptions().threads;
};

/// Runs the first episode. Returns false if it fails or another worker runs it. Throws InputError
/// for a fault that would affect every episode.
bool MakeFirst(const Plan& plan) {
  try {
    return RunEpisode(plan, 0, {.threads = 1});
  } catch (const InputError&) {
    if (!std::filesystem::exists(plan.FailureFile(0))) throw;
    return false;
  }
}

/// The outcome of the first episode is determined before other episodes run, so that a faulty
/// command or figure costs only one episode.
void RunSweep(const SweepArguments& arguments) {
  const Plan plan = MakePlan(arguments.campaign, arguments.out);
  if (!plan.campaign.outcome || plan.campaign.factors.empty()) {
    throw InputError(arguments.campaign.string(),
                     {FaultKind::kMissing,
                      "a sweep has factors and an outcome; need factors: [...] and outcome: {run, "
                      "report, figure}"});
  }
  const SweepOptions options{.worker = {std::filesystem::read_symlink("/proc/self/exe"), {}},
                             .processes = arguments.processes};
  const CampaignState before = RefreshIndex(plan);
  if (before.done.empty() && before.failed.empty() && MakeFirst(plan)) OutcomeOf(plan, 0, options);
  const CampaignState state = RunPool(
      plan,
      {.worker = options.worker, .processes = arguments.processes, .progress = [](const auto& now) {
         fmt::print(stderr, "{} of {} done, {} failed\n", now.done, now.episodes, now.failed);
       }});
  std::vector<int> numbers;
  for (const auto& [number, record] : state.done) numbers.push_back(number);
  if (numbers.empty()) {
    throw InputError(plan.folder.string(),
                     {FaultKind::kMissing,
                      "no episode could be made; `tera campaign status` prints the reasons"});
  }
  const SweepResult sweep = TakeSweep(plan, numbers, options);
  WriteSweep(sweep, plan);
  fmt::print("{}: {} of {} runs over {} in sweep.md, sweep.svg, sweep.csv, runs.csv\n",
             plan.folder.string(), sweep.runs.size(), plan.campaign.episodes, sweep.figure);
  if (!state.failed.empty()) throw CLI::RuntimeError(1);
}

}  // namespace

void AddSweepCommand(CLI::App* app) {
  auto arguments = std::make_shared<SweepArguments>();
  CLI::App* command = app->add_subcommand(
      "sweep",
      "Measure how factors of a scenario change a figure of a report (docs/reference/campaign.md)");
  command->add_option("CAMPAIGN", arguments->campaign, "Campaign file (YAML) with an outcome")
      ->required();
  command
      ->add_option("--out", arguments->out, "Folder of the sweep; an existing sweep is continued")
      ->required();
  command
      ->add_option("--processes", arguments->processes,
                   "Most episodes and commands at once; number of cores")
      ->check(WholeNumberBetween(1, 4096));
  command->callback([arguments] { RunSweep(*arguments); });
}

}  // namespace tera
