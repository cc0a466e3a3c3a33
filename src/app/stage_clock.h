#pragma once

#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include "core/stopwatch.h"

namespace tera {

/// Wall-clock seconds of a command and of its stages, in the order in which they ended. For reports;
/// never for data.
class StageClock {
 public:
  /// What `work` returns; its time counts for the stage.
  template <typename Work>
  auto Time(const std::string& stage, const Work& work) {
    Clocked clocked{this, stage};
    const Stopwatch stopwatch(&clocked.wall_s);
    return work();
  }
  void Add(const std::string& stage, double wall_s);
  /// A line for each stage, for everything else and for all since this began.
  std::string Table() const;

 private:
  /// Adds its seconds when it ends, after the stopwatch that counts them.
  struct Clocked {
    StageClock* clock;
    std::string stage;
    double wall_s = 0;
    ~Clocked() { clock->Add(stage, wall_s); }
  };

  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::vector<std::pair<std::string, double>> stages_;
};

}  // namespace tera
