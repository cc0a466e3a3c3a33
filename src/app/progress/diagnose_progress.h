#pragma once

#include <chrono>
#include <map>
#include <string>

#include "core/stage_clock.h"
#include "diagnose/diagnose_blocks.h"

namespace tera {

/// Shows the progress of a diagnosis. The search is a stage of the clock, each block a part.
/// Standard error receives a line with result and time per block; a terminal also shows the current
/// blocks.
class DiagnoseProgress {
 public:
  /// `clock` must outlive this object.
  explicit DiagnoseProgress(StageClock* clock);
  void Show(const BlockProgress& progress);

 private:
  using Clock = std::chrono::steady_clock;

  bool terminal_;
  StageClock* clock_;
  Clock::time_point start_, search_start_;
  std::map<std::string, Clock::time_point> block_starts_;  ///< blocks under search
};

}  // namespace tera
