#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "app/arguments/argument_checks.h"
#include "app/arguments/scenario_options.h"
#include "app/commands.h"
#include "app/progress/progress_bar.h"
#include "core/error.h"
#include "dataset/files/checked_file.h"
#include "dataset/files/whole_folder.h"
#include "layout/compare/comparison_page.h"
#include "layout/evaluate.h"
#include "layout/optimise/found_files.h"
#include "layout/optimise/optimise.h"
#include "layout/report/answer.h"
#include "layout/report/report_json.h"
#include "layout/report/words.h"
#include "layout/report/write_report.h"

namespace tera {
namespace fs = std::filesystem;
namespace {

constexpr double kSearchLine_s = 30;  ///< interval between progress lines if the output is not a
                                      ///< terminal

struct EvaluateArguments {
  fs::path cycle, study, out;
  std::vector<fs::path> rigs;
  std::vector<std::string> moved;
  bool strict = false;
  HostOptions host;
};

void RequireNew(const fs::path& out) {
  RequireNoneStopped(out);
  RequireNothingAt(out);
}

std::vector<Layout> LoadLayouts(const EvaluateArguments& arguments, const Cycle& cycle,
                                std::size_t machine) {
  std::vector<Layout> layouts;
  std::set<std::string> names;
  for (const fs::path& rig : arguments.rigs) {
    layouts.push_back(LoadLayout(rig, cycle, machine));
    if (!names.insert(layouts.back().name).second) {
      throw InputError(rig.string(), {FaultKind::kRepeated,
                                      fmt::format("another rig has the name '{}' too, and each "
                                                  "report has the name of its rig; rename one",
                                                  layouts.back().name)});
    }
  }
  return layouts;
}

void RunEvaluate(const EvaluateArguments& arguments) {
  RequireNew(arguments.out);
  const LayoutStudy study = LoadStudy(arguments.study);
  const Cycle cycle(arguments.cycle, arguments.moved);
  const std::size_t machine = FindMachine(study, cycle.scenario()).machine;
  std::vector<LayoutReport> reports;
  {
    ProgressBar bar(kSearchLine_s);
    reports = Evaluate(cycle, study, LoadLayouts(arguments, cycle, machine),
                       {.threads = arguments.host.threads,
                        .strict = arguments.strict,
                        .progress = [&](double done_s, double duration_s) {
                          bar.Show({done_s, duration_s, 0});
                        }});
  }
  WholeFolder folder(arguments.out);
  for (const LayoutReport& report : reports) {
    WriteReport(report, folder.temporary() / report.name);
  }
  folder.Commit();
  for (const LayoutReport& report : reports) {
    for (const std::string& line : Answer(report)) fmt::print("{}: {}\n", report.name, line);
    for (const std::string& warning : report.warnings) fmt::print("warning: {}\n", warning);
    fmt::print("report: {}\n", (arguments.out / report.name / "report.html").string());
  }
}

struct CompareArguments {
  std::vector<fs::path> reports;
  fs::path out;
};

/// Folder of a report. `report` is the folder or its layout.json.
fs::path FolderOf(const fs::path& report) {
  const fs::path plain = report.lexically_normal();
  const fs::path folder = plain.filename() == "layout.json" ? plain.parent_path() : plain;
  return folder.has_filename() ? folder : folder.parent_path();
}

/// Reads the reports. Reports with equal names are named after their folders.
std::vector<LayoutReport> ReadReports(const std::vector<fs::path>& files) {
  std::vector<LayoutReport> reports;
  std::map<std::string, int> named;
  std::map<fs::path, fs::path> known;
  for (const fs::path& file : files) {
    reports.push_back(ReadReport(file));
    ++named[reports.back().name];
    const auto [same, is_new] = known.emplace(fs::weakly_canonical(FolderOf(file)), file);
    if (is_new) continue;
    throw InputError(file.string(),
                     {FaultKind::kRepeated,
                      fmt::format("is the same report as {}; need another to compare it with",
                                  same->second.string())});
  }
  for (std::size_t r = 0; r < reports.size(); ++r) {
    if (named[reports[r].name] > 1) reports[r].name = FolderOf(files[r]).generic_string();
  }
  return reports;
}

void RunCompare(const CompareArguments& arguments) {
  RequireNew(arguments.out);
  const std::vector<LayoutReport> reports = ReadReports(arguments.reports);
  WholeFolder folder(arguments.out);
  WriteWholeFile(folder.temporary() / "comparison.csv", ComparisonCsv(reports));
  WriteWholeFile(folder.temporary() / "comparison.html", ComparisonPage(reports));
  folder.Commit();
  for (const std::string& line : ComparisonWords(reports)) fmt::print("{}\n", line);
  fmt::print("report: {}\n", (arguments.out / "comparison.html").string());
}

void AddEvaluate(CLI::App* app) {
  auto arguments = std::make_shared<EvaluateArguments>();
  CLI::App* command =
      app->add_subcommand("evaluate", "Evaluate the coverage of rigs over a work cycle");
  command
      ->add_option("CYCLE", arguments->cycle,
                   "Dataset of `tera generate --keep-state`, or a scenario, which is simulated")
      ->required();
  command->add_option("RIG", arguments->rigs, "Rig files (YAML)")->required();
  command->add_option("--study", arguments->study,
                      "Study (YAML): zones, heights, people; without it the default study");
  command->add_option("--out", arguments->out, "Folder of the reports; new or empty")->required();
  command->add_flag(
      "--strict", arguments->strict,
      "Treat a mount inside the machine, or one that sees next to nothing, as an error");
  AddMovedOption(command, &arguments->moved);
  AddHostOptions(command, &arguments->host);
  command->callback([arguments] { RunEvaluate(*arguments); });
}

void AddCompare(CLI::App* app) {
  auto arguments = std::make_shared<CompareArguments>();
  CLI::App* command = app->add_subcommand("compare", "Compare each layout with the first");
  command
      ->add_option("REPORT", arguments->reports,
                   "Two or more layouts of one cycle: folders that `tera layout evaluate` wrote, "
                   "or their layout.json; the first is the reference")
      ->required()
      ->expected(-2);  // at least two
  command->add_option("--out", arguments->out, "Folder of the comparison; new or empty")
      ->required();
  command->callback([arguments] { RunCompare(*arguments); });
}

struct OptimiseArguments {
  fs::path search, out;
  bool resume = false;
  HostOptions host;
};

void RunOptimise(const OptimiseArguments& arguments) {
  const LayoutSearch search = LoadSearch(arguments.search);
  const OptimiseResult result =
      Optimise(search, ReadWholeFile(arguments.search),
               {.out = arguments.out,
                .threads = arguments.host.threads,
                .resume = arguments.resume,
                .progress = [](const OptimiseProgress& now) {
                  fmt::print("generation {} of {}: hypervolume {:.5g}\n", now.generation,
                             now.generations, now.hypervolume);
                  std::fflush(stdout);
                }});
  for (const std::string& warning : result.warnings) fmt::print("warning: {}\n", warning);
  fmt::print("{} on the Pareto front: {}\n", LayoutCount(result.front.size()),
             (arguments.out / "front").string());
  fmt::print("report: {}\n", (arguments.out / "search.html").string());
}

void AddOptimise(CLI::App* app) {
  auto arguments = std::make_shared<OptimiseArguments>();
  CLI::App* command =
      app->add_subcommand("optimise", "Search for layouts with more coverage at less cost");
  command
      ->add_option("SEARCH", arguments->search,
                   "Search file (YAML): sensors, mounts, limits and objectives")
      ->required();
  command->add_option("--out", arguments->out, "Folder of the result; new or empty")->required();
  command->add_flag("--resume", arguments->resume, "Resume an interrupted search");
  AddHostOptions(command, &arguments->host);
  command->callback([arguments] { RunOptimise(*arguments); });
}

}  // namespace

void AddLayoutCommand(CLI::App* app) {
  CLI::App* command = app->add_subcommand("layout", "Evaluate, compare and search sensor layouts");
  command->require_subcommand(1);
  AddEvaluate(command);
  AddCompare(command);
  AddOptimise(command);
}

}  // namespace tera
