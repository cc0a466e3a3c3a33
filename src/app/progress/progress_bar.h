#pragma once

#include <chrono>

#include "sim/run/generate.h"

namespace tera {

/// One line on a terminal that follows a run: simulated time, real-time factor, frames, time left.
/// Says nothing where standard error is no terminal.
class ProgressBar {
 public:
  ProgressBar();
  ~ProgressBar();  ///< leaves the cursor on a fresh line
  void Show(const GenerateProgress& progress);

 private:
  bool terminal_, shown_ = false;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace tera
