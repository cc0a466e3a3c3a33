#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <string>

#include "soil_figures/figures.h"

// soil_figures SEED [GROUP...]: prints `name value`, a line for each figure of these groups, or of
// all. The seed scatters clods.

int main(int argc, char** argv) {
  using namespace tera::bench;
  const std::map<std::string, std::function<Figures(std::uint64_t)>> groups = {
      {"tool", ToolFigures},
      {"flow", FlowFigures},
      {"track", [](std::uint64_t) { return TrackFigures(); }},
      {"dig", DigFigures}};
  if (argc < 2) {
    fmt::print(stderr, "soil_figures SEED [tool|flow|track|dig]...\n");
    return 2;
  }
  const std::uint64_t seed = std::stoull(argv[1]);
  const std::vector<std::string> asked(argv + 2, argv + argc);
  for (const auto& [name, figures] : groups) {
    if (!asked.empty() && std::find(asked.begin(), asked.end(), name) == asked.end()) continue;
    for (const Figure& figure : figures(seed)) fmt::print("{} {:.6g}\n", figure.name, figure.value);
  }
}
