#pragma once

#include <chrono>
#include <map>
#include <string>

#include "core/stage_clock.h"
#include "diagnose/diagnose_blocks.h"

namespace tera {

/// Follows a diagnosis: the search is a stage of the clock, each block a part. On standard error a
/// line for each block that says what came of it and when; on a terminal, under them, what is being
/// looked at.
class DiagnoseProgress {
 public:
  /// The clock must outlive it.
  explicit DiagnoseProgress(StageClock* clock);
  void Show(const BlockProgress& progress);

 private:
  using Clock = std::chrono::steady_clock;

  bool terminal_;
  StageClock* clock_;
  Clock::time_point start_, search_start_;
  std::map<std::string, Clock::time_point> block_starts_;  ///< of those that are searched now
};

}  // namespace tera
