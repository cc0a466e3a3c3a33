#include "core/stage_clock.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace tera {

void StageClock::Add(const std::string& stage, double wall_s) {
  auto same = std::find_if(stages_.begin(), stages_.end(),
                           [&](const Stage& one) { return one.name == stage; });
  if (same == stages_.end()) same = stages_.insert(same, {stage, 0, {}});
  same->wall_s += wall_s;
  same->parts.insert(same->parts.end(), parts_.begin(), parts_.end());
  parts_.clear();
}

void StageClock::AddPart(const std::string& part, double wall_s) {
  parts_.emplace_back(part, wall_s);
}

std::string StageClock::Table() const {
  std::string table = fmt::format("  {:<36} {:>7}\n", "stage", "wall s");
  const auto line = [](const std::string& stage, double wall_s) {
    return fmt::format("  {:<36} {:>7.1f}\n", stage, wall_s);
  };
  const double all_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  double else_s = all_s;
  for (const Stage& stage : stages_) {
    table += line(stage.name, stage.wall_s);
    for (const auto& [part, wall_s] : stage.parts) table += line("  " + part, wall_s);
    else_s -= stage.wall_s;
  }
  return table + line("everything else", else_s) + line("in all", all_s);
}

}  // namespace tera
