#include "app/stage_clock.h"

#include <fmt/format.h>

#include <algorithm>

namespace tera {

void StageClock::Add(const std::string& stage, double wall_s) {
  const auto same = std::find_if(stages_.begin(), stages_.end(),
                                 [&](const auto& one) { return one.first == stage; });
  if (same == stages_.end()) {
    stages_.emplace_back(stage, wall_s);
  } else {
    same->second += wall_s;
  }
}

std::string StageClock::Table() const {
  std::string table = fmt::format("  {:<36} {:>7}\n", "stage", "wall s");
  const auto line = [](const std::string& stage, double wall_s) {
    return fmt::format("  {:<36} {:>7.1f}\n", stage, wall_s);
  };
  const double all_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  double else_s = all_s;
  for (const auto& [stage, wall_s] : stages_) {
    table += line(stage, wall_s);
    else_s -= wall_s;
  }
  return table + line("everything else", else_s) + line("in all", all_s);
}

}  // namespace tera
