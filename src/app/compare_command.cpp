#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>

#include "app/commands.h"
#include "dataset/compare/compare.h"

namespace tera {

void AddCompareCommand(CLI::App* app) {
  struct Arguments {
    std::string first, second, plot;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app->add_subcommand(
      "compare",
      "Compare two recordings, simulated or real: trajectories, receivers, IMUs, joints");
  command->add_option("REFERENCE", arguments->first, "Dataset taken as the reference")->required();
  command->add_option("DATASET", arguments->second, "Dataset to judge")->required();
  command->add_option("--plot", arguments->plot, "PNG to write; none without it");
  command->callback([arguments] {
    const Comparison comparison = Compare(arguments->first, arguments->second);
    fmt::print("{}", ComparisonTable(comparison));
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
