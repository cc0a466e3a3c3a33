#pragma once

#include <chrono>

namespace tera {

/// Measures the wall-clock seconds of its own lifetime and adds them to a sum. Only reports show
/// these times; datasets never contain them.
class Stopwatch {
 public:
  explicit Stopwatch(double* sum_s) : sum_s_(sum_s), start_(Clock::now()) {}
  ~Stopwatch() { *sum_s_ += std::chrono::duration<double>(Clock::now() - start_).count(); }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  using Clock = std::chrono::steady_clock;
  double* sum_s_;
  Clock::time_point start_;
};

}  // namespace tera
