#pragma once

#include <chrono>
#include <string_view>

#include "sim/run/generate.h"

namespace tera {

/// One line on a terminal that follows a run: simulated time, real-time factor, frames, time left.
/// Where standard error is no terminal it says nothing, or a whole line at times.
class ProgressBar {
 public:
  /// `line_s` is the least time between lines where there is no terminal; 0: none is written.
  explicit ProgressBar(double line_s = 0);
  ~ProgressBar();  ///< leaves the cursor on a fresh line
  /// `counted` are what the progress counts as frames.
  void Show(const GenerateProgress& progress, std::string_view counted = "frames");

 private:
  bool terminal_, shown_ = false;
  double line_s_, last_line_s_ = 0;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace tera
