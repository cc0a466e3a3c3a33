#pragma once

#include <ctime>

namespace tera::bench {

/// Adds the processor time that this process spends in its lifetime to a sum: what others do on the
/// same machine counts less than in wall-clock time.
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
