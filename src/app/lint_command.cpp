#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include "app/arguments/argument_checks.h"
#include "app/commands.h"
#include "core/error.h"
#include "dataset/files/checked_file.h"
#include "dataset/format/recording.h"
#include "dataset/lint/lint.h"
#include "dataset/lint/report/lint_report.h"
#include "sim/recorded_ground.h"

namespace tera {
namespace {

constexpr int kFound = 1;
/// Upper limit of the option that skips frames.
constexpr int kMostSpread = 1'000'000;

struct LintArguments {
  std::string dataset, json, sarif, statistics;
  int every_frame = 1;
  bool strict = false, rules = false, write_hashes = false;
};

void WriteFiles(const LintArguments& arguments, const LintReport& report) {
  if (!arguments.json.empty()) WriteWholeFile(arguments.json, LintJson(report));
  if (!arguments.sarif.empty()) WriteWholeFile(arguments.sarif, LintSarif(report));
  if (!arguments.statistics.empty()) {
    WriteWholeFile(arguments.statistics, LintStatisticsPage(report));
  }
}

/// A dataset with errors gets no hashes, because hashes certify a dataset without errors.
void WriteHashes(const LintArguments& arguments, bool found_errors) {
  if (found_errors) {
    fmt::print("{}: not written because of errors\n", kFrameHashesName);
    return;
  }
  fmt::print("{}: {} files\n", kFrameHashesName, WriteFrameHashes(arguments.dataset));
}

/// Lint options with a function that reads ground heights of the dataset.
LintOptions LintOptionsOf(const LintArguments& arguments) {
  const ReadGround read = ReaderOfGround(Recording(arguments.dataset).info());
  const auto lowest_m = [read](const std::filesystem::path& raster) {
    double lowest = std::numeric_limits<double>::infinity();
    for (const float height_m : read(raster, "elevation").values) {
      if (std::isfinite(height_m)) lowest = std::min<double>(lowest, height_m);
    }
    return lowest;
  };
  return {.every_frame = arguments.every_frame, .lowest_m = lowest_m};
}

void RunLint(const LintArguments& arguments) {
  if (arguments.rules) {
    fmt::print("{}", LintRulesTable());
    return;
  }
  if (arguments.dataset.empty()) {
    throw InputError("DATASET", {FaultKind::kMissing,
                                 "is missing; name the folder of a dataset, or use --rules"});
  }
  const LintReport report = Lint(arguments.dataset, LintOptionsOf(arguments));
  fmt::print("{}", LintTable(report));
  WriteFiles(arguments, report);
  const bool found_errors = report.CountOf(Severity::kError) > 0;
  if (arguments.write_hashes) WriteHashes(arguments, found_errors);
  const bool found_warnings = report.CountOf(Severity::kWarning) > 0;
  if (found_errors || (arguments.strict && found_warnings)) throw CLI::RuntimeError(kFound);
}

}  // namespace

void AddLintCommand(CLI::App* app) {
  auto arguments = std::make_shared<LintArguments>();
  CLI::App* command = app->add_subcommand(
      "lint", "Check a dataset against the rules of its format and for contradictions");
  command->add_option("DATASET", arguments->dataset, "Dataset directory");
  command->add_option("--json", arguments->json, "Report to write, see docs/reference/lint.md");
  command->add_option("--sarif", arguments->sarif, "Report to write as SARIF 2.1.0");
  command->add_option("--statistics", arguments->statistics,
                      "Page (HTML) to write with statistics of the dataset");
  command
      ->add_option("--sample", arguments->every_frame,
                   "Check one of so many frames of each camera and lidar (1: all)")
      ->check(WholeNumberBetween(1, kMostSpread));
  command->add_flag("--strict", arguments->strict, "Warnings count too: end with status 1");
  command->add_flag(
      "--write-hashes", arguments->write_hashes,
      "Write frames.sha256 if there is no error; later runs check the files against it");
  command->add_flag("--rules", arguments->rules, "List all rules without a dataset");
  command->callback([arguments] { RunLint(*arguments); });
}

}  // namespace tera
