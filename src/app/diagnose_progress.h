#pragma once

#include <chrono>
#include <string>

#include "app/stage_clock.h"
#include "diagnose/diagnosis.h"

namespace tera {

/// Follows a diagnosis: each block's search is a stage of the clock. On a terminal a line for each
/// block, which first says that it is being looked at, then what came of it and when; nothing where
/// standard error is no terminal.
class DiagnoseProgress {
 public:
  /// The clock must outlive it.
  DiagnoseProgress(std::string machine, StageClock* clock);
  void Show(const BlockProgress& progress);

 private:
  using Clock = std::chrono::steady_clock;

  std::string machine_;
  bool terminal_;
  StageClock* clock_;
  Clock::time_point start_, block_start_;
};

}  // namespace tera
