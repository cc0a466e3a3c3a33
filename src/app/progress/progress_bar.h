#pragma once

#include <chrono>
#include <string_view>

#include "sim/run/generate.h"

namespace tera {

/// One terminal line with a run's progress: simulated time, real-time factor, frames and time left.
/// Without a terminal, it writes nothing or an occasional whole line.
class ProgressBar {
 public:
  /// `line_s` is the minimum time between lines without a terminal; 0: no lines.
  explicit ProgressBar(double line_s = 0);
  ~ProgressBar();  ///< moves the cursor to a new line
  /// `counted` is the word after the count: "frames" or "records".
  void Show(const GenerateProgress& progress, std::string_view counted = "frames");

 private:
  bool terminal_, shown_ = false;
  double line_s_, last_line_s_ = 0;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace tera
