#pragma once

#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include "core/stopwatch.h"

namespace tera {

/// Wall-clock seconds of a command and of its stages, in the order in which the stages end. Reports
/// use these times; data never do.
class StageClock {
 public:
  /// Returns the result of `work` and adds its time to the stage.
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
  /// Adds a part of the next stage that Add records. Parts may run concurrently.
  void AddPart(const std::string& part, double wall_s);
  /// One line per stage, one for the remaining time and one for the total.
  std::string Table() const;

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  struct Stage {
    std::string name;
    double wall_s = 0;
    std::vector<std::pair<std::string, double>> parts;
  };
  std::vector<Stage> stages_;
  std::vector<std::pair<std::string, double>> parts_;  ///< parts of the next stage
};

}  // namespace tera
