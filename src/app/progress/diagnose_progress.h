#pragma once

#include <chrono>
#include <map>
#include <string>

#include "core/stage_clock.h"
#include "diagnose/diagnose_blocks.h"

namespace tera {

/// Shows the progress of a diagnosis. Standard error receives one line per block, with result and
/// time; a terminal also shows the blocks in progress. In `clock`, the search is a stage and each
/// block a part of it.
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
  std::map<std::string, Clock::time_point> block_starts_;  ///< start times of the blocks in
                                                           ///< progress
};

}  // namespace tera
