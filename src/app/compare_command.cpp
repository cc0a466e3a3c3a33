#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>

#include "app/arguments/argument_checks.h"
#include "app/commands.h"
#include "dataset/compare/compare.h"
#include "dataset/compare/comparison_report.h"
#include "dataset/files/checked_file.h"

namespace tera {

void AddCompareCommand(CLI::App* app) {
  constexpr int kMostSpread = 1'000'000;
  struct Arguments {
    std::string first, second, plot, json, frames;
    int every = 1;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app->add_subcommand(
      "compare",
      "Compare two recordings, simulated or real: trajectories, receivers, IMUs, joints, scans, "
      "pictures");
  command->add_option("REFERENCE", arguments->first, "Dataset taken as the reference")->required();
  command->add_option("DATASET", arguments->second, "Dataset to judge")->required();
  command->add_option("--plot", arguments->plot, "PNG to write; none without it");
  command
      ->add_option("--sample", arguments->every,
                   "Compare only one of so many pairs of scans and pictures (1: all)")
      ->check(WholeNumberBetween(1, kMostSpread));
  command->add_option("--json", arguments->json, "File to write the numbers to");
  command->add_option("--worst", arguments->frames,
                      "New folder for the scans and pictures that differ most, side by side");
  command->callback([arguments] {
    const Comparison comparison =
        Compare(arguments->first, arguments->second, static_cast<std::size_t>(arguments->every));
    fmt::print("{}", ComparisonTable(comparison));
    if (!arguments->json.empty()) WriteWholeFile(arguments->json, ComparisonJson(comparison));
    if (!arguments->frames.empty()) {
      fmt::print(
          "{} pairs in {}\n",
          WriteWorstFrames(comparison, arguments->first, arguments->second, arguments->frames),
          arguments->frames);
    }
    if (arguments->plot.empty()) return;
    const auto& machines = comparison.machines;
    if (std::any_of(machines.begin(), machines.end(),
                    [](const MachineComparison& m) { return !m.tracks.empty(); })) {
      PlotComparison(comparison, arguments->plot);
      fmt::print("plot: {}\n", arguments->plot);
    } else {
      fmt::print("no plot: no machine has poses or receivers on both sides\n");
    }
  });
}

}  // namespace tera
