#pragma once

#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include "core/stopwatch.h"

namespace tera {

/// Wall-clock seconds of a command and its stages, in the order in which the stages end. Only
/// reports show these times; datasets never contain them.
class StageClock {
 public:
  /// Runs `work`, adds its duration to the stage and returns its result.
  template <typename Work>
  auto Time(const std::string& stage, const Work& work) {
    double wall_s = 0;
    auto result = [&] {
      const Stopwatch stopwatch(&wall_s);
      return work();
    }();
    Add(stage, wall_s);
    return result;
  }
  void Add(const std::string& stage, double wall_s);
  /// Adds the duration of a part of the next stage that Add records. Parts may overlap in time.
  void AddPart(const std::string& part, double wall_s);
  /// One line per stage, a line for the remaining time and a line for the total.
  std::string Table() const;

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  struct Stage {
    std::string name;
    double wall_s = 0;
    std::vector<std::pair<std::string, double>> parts;
  };
  std::vector<Stage> stages_;
  std::vector<std::pair<std::string, double>> parts_;
};

}  // namespace tera
