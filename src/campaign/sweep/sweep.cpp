#include "campaign/sweep/sweep.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <string_view>
#include <utility>

#include "campaign/sweep/report_figure.h"
#include "campaign/sweep/sweep_plot.h"
#include "core/error.h"
#include "core/workers.h"
#include "dataset/files/checked_file.h"

namespace tera {
namespace fs = std::filesystem;
namespace {

std::string EndOf(const fs::path& log) {
  constexpr std::size_t kMostBytes = 2000;
  const std::string text = ReadWholeFile(log);
  return text.size() <= kMostBytes ? text : text.substr(text.size() - kMostBytes);
}

/// Runs a program in `folder` with its output in `log`. Returns its exit status, or -1.
int RunIn(const fs::path& folder, std::vector<std::string> words, const fs::path& log) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, log.c_str(),
                                   O_WRONLY | O_CREAT | O_TRUNC, 0644);
  posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  pid_t child = 0;
  const int error = posix_spawn(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  int status = 0;
  if (error != 0 || waitpid(child, &status, 0) != child || !WIFEXITED(status)) return -1;
  return WEXITSTATUS(status);
}

std::string Replaced(std::string text, const std::string& word, const std::string& by) {
  for (std::size_t at = 0; (at = text.find(word, at)) != std::string::npos; at += by.size()) {
    text.replace(at, word.size(), by);
  }
  return text;
}

/// The file `name` below `folder`. "*/" stands for the only folder that contains it.
fs::path ReportIn(const fs::path& folder, const std::string& name) {
  constexpr std::string_view kAnyFolder = "*/";
  if (!name.starts_with(kAnyFolder) || !fs::exists(folder)) return folder / name;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const fs::path file = entry.path() / name.substr(kAnyFolder.size());
    if (fs::exists(file)) return file;
  }
  return folder / name;
}

std::string MarkdownTable(const FactorEffect& effect) {
  std::string text = fmt::format(
      "| {} | runs | mean | 95 % interval of the mean |\n|---|---|---|---|\n", effect.key);
  for (const LevelMean& level : effect.levels) {
    text += fmt::format("| {} | {} | {:.5g} | {} |\n", level.level, level.runs, level.mean,
                        level.low ? fmt::format("{:.5g} to {:.5g}", *level.low, *level.high) : "");
  }
  if (effect.slope) {
    text += fmt::format("\nSlope over {}: {:.4g} per unit, 95 % interval {:.4g} to {:.4g}.\n",
                        effect.key, effect.slope->per_unit, effect.slope->low, effect.slope->high);
  }
  return text + "\n";
}

}  // namespace

double OutcomeOf(const Plan& plan, int number, const SweepOptions& options) {
  const SweepOutcome& outcome = *plan.campaign.outcome;
  const fs::path folder = plan.folder / "outcomes" / EpisodeName(number);
  fs::path report = ReportIn(folder, outcome.report);
  if (!fs::exists(report)) {
    const fs::path part = folder.string() + ".part";
    std::error_code nothing_there;
    fs::remove_all(part, nothing_there);  // left by a command that failed or was killed
    fs::remove_all(folder, nothing_there);
    MakeFolder(part);
    std::vector<std::string> words = {options.worker.program.string()};
    std::vector<SetValue> named = DesignPoint(plan.campaign, number);
    named.push_back({"episode", (plan.EpisodeFolder(number) / "data").string()});
    named.push_back({"out", part.string()});
    for (std::string word : outcome.run) {
      for (const SetValue& value : named) word = Replaced(word, "{" + value.key + "}", value.yaml);
      words.push_back(std::move(word));
    }
    const fs::path log = plan.folder / "logs" / (EpisodeName(number) + "_outcome.log");
    const int status = RunIn(plan.campaign.folder, words, log);
    if (status != 0) {
      throw InputError(outcome.place, {FaultKind::kInconsistent,
                                       fmt::format("the command ended with status {} for episode "
                                                   "{}; correct what it says:\n{}",
                                                   status, number, EndOf(log))});
    }
    report = ReportIn(part, outcome.report);
    if (!fs::exists(report)) {
      throw InputError(outcome.report_place,
                       {FaultKind::kUnreadable,
                        fmt::format("the command wrote no {}; need a report that it writes below "
                                    "{{out}}",
                                    report.string())});
    }
    fs::rename(part, folder);
    report = ReportIn(folder, outcome.report);
  }
  return ReportFigure(report, outcome.figure, outcome.figure_place);
}

SweepResult TakeSweep(const Plan& plan, const std::vector<int>& numbers,
                      const SweepOptions& options) {
  SweepResult sweep{plan.campaign.outcome->figure, {}, {}};
  std::vector<std::string> keys;
  for (const DesignFactor& factor : plan.campaign.factors) keys.push_back(factor.key);
  for (const int number : numbers) {
    SweptRun& run = sweep.runs.emplace_back(SweptRun{.number = number, .values = {}});
    for (const SetValue& value : DesignPoint(plan.campaign, number))
      run.values.push_back(value.yaml);
  }
  Workers(options.processes)
      .ForRanges(sweep.runs.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
          sweep.runs[k].outcome = OutcomeOf(plan, sweep.runs[k].number, options);
        }
      });
  sweep.effects = EffectsOf(keys, sweep.runs);
  return sweep;
}

void WriteSweep(const SweepResult& sweep, const Plan& plan) {
  std::string runs = "number,seed";
  for (const FactorEffect& effect : sweep.effects) runs += "," + CsvField(effect.key);
  runs += "," + CsvField(sweep.figure) + "\n";
  for (const SweptRun& run : sweep.runs) {
    runs += fmt::format("{},{}", run.number, EpisodeSeed(plan.campaign, run.number, 0));
    for (const std::string& value : run.values) runs += "," + CsvField(value);
    runs += fmt::format(",{}\n", run.outcome);
  }
  std::string levels = "factor,level,runs,mean,low_95,high_95\n";
  std::string page = fmt::format(
      "# {}\n\nOutcome: {}, from {} runs.\n\n![Outcome over the factors](sweep.svg)\n\n",
      plan.campaign.name, sweep.figure, sweep.runs.size());
  for (const FactorEffect& effect : sweep.effects) {
    for (const LevelMean& level : effect.levels) {
      levels += fmt::format("{},{},{},{},{},{}\n", CsvField(effect.key), CsvField(level.level),
                            level.runs, level.mean, level.low ? fmt::format("{}", *level.low) : "",
                            level.high ? fmt::format("{}", *level.high) : "");
    }
    page += MarkdownTable(effect);
  }
  WriteWholeFile(plan.folder / "runs.csv", runs);
  WriteWholeFile(plan.folder / "sweep.csv", levels);
  WriteWholeFile(plan.folder / "sweep.svg", SweepPlot(sweep.effects, sweep.runs, sweep.figure));
  WriteWholeFile(plan.folder / "sweep.md", page);
}

}  // namespace tera
