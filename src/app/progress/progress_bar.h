#pragma once

#include <chrono>
#include <string_view>

#include "sim/run/generate.h"

namespace tera {

/// Progress of a run on one terminal line: simulated time, real-time factor, frames and remaining
/// time. If the output is not a terminal, it prints a new line from time to time, or nothing.
class ProgressBar {
 public:
  /// `line_s` is the least interval between lines if the output is not a terminal; 0: no lines.
  explicit ProgressBar(double line_s = 0);
  ~ProgressBar();  ///< moves the cursor to a new line
  /// `counted` names what is counted: "frames" or "records".
  void Show(const GenerateProgress& progress, std::string_view counted = "frames");

 private:
  bool terminal_, shown_ = false;
  double line_s_, last_line_s_ = 0;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace tera
