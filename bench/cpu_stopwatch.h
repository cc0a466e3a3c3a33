#pragma once

#include <ctime>

namespace tera::bench {

/// Adds this process's processor time during the object's lifetime to a sum. Other processes
/// disturb it less than wall-clock time.
class CpuStopwatch {
 public:
  explicit CpuStopwatch(double* sum_s) : sum_s_(sum_s), start_(std::clock()) {}
  ~CpuStopwatch() { *sum_s_ += static_cast<double>(std::clock() - start_) / CLOCKS_PER_SEC; }
  CpuStopwatch(const CpuStopwatch&) = delete;
  CpuStopwatch& operator=(const CpuStopwatch&) = delete;

 private:
  double* sum_s_;
  std::clock_t start_;
};

}  // namespace tera::bench
