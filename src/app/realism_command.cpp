#include <fmt/format.h>

#include <memory>
#include <string>

#include "app/arguments/argument_checks.h"
#include "app/commands.h"
#include "dataset/files/checked_file.h"
#include "dataset/realism/realism.h"

namespace tera {

void AddRealismCommand(CLI::App* app) {
  constexpr int kMostSpread = 1'000'000;
  struct Arguments {
    std::string dataset, json;
    int every_frame = 1;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app->add_subcommand(
      "realism", "Compare statistics of a dataset's colour pictures with those of photographs");
  command->add_option("DATASET", arguments->dataset, "Dataset directory")->required();
  command->add_option("--sample", arguments->every_frame, "Evaluate one of so many frames (1: all)")
      ->check(WholeNumberBetween(1, kMostSpread));
  command->add_option("--json", arguments->json, "File to write the numbers to");
  command->callback([arguments] {
    const Realism realism = MeasureRealism(arguments->dataset, arguments->every_frame);
    fmt::print("{}", RealismTable(realism));
    if (!arguments->json.empty()) WriteWholeFile(arguments->json, RealismJson(realism));
  });
}

}  // namespace tera
