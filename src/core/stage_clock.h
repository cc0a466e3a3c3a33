#pragma once

#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include "core/stopwatch.h"

namespace tera {

/// Wall-clock seconds of a command and of its stages, in the order in which they ended. For
/// reports; never for data.
class StageClock {
 public:
  /// What `work` returns; its time counts for the stage.
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
  /// A part of the stage that is added next, of which several may go on at once.
  void AddPart(const std::string& part, double wall_s);
  /// A line for each stage, for everything else and for all since this began.
  std::string Table() const;

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  struct Stage {
    std::string name;
    double wall_s = 0;
    std::vector<std::pair<std::string, double>> parts;
  };
  std::vector<Stage> stages_;
  std::vector<std::pair<std::string, double>> parts_;  ///< of the next one
};

}  // namespace tera
