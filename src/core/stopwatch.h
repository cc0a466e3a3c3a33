#pragma once

#include <chrono>

namespace tera {

/// Adds the wall-clock seconds of its lifetime to a sum. Reports use these times; data never do.
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
