#pragma once

#include <benchmark/benchmark.h>

#include <string>
#include <vector>

/// A benchmark reports its figure's distance from the target as the label at the end of its line. A
/// program of benchmarks fails if any target is missed (RunAndJudge).

namespace tera::bench {

/// A figure's bound and unit. `what` names the figure.
struct Target {
  std::string what;
  double least_or_most = 0;
  std::string unit;
};

void ExpectAtLeast(const Target& target, double measured, benchmark::State* state);
void ExpectAtMost(const Target& target, double measured, benchmark::State* state);
/// Several figures, and a remark.
struct Measured {
  Target target;
  double figure = 0;
};
void ExpectAtMost(const std::vector<Measured>& figures, const std::string& remark,
                  benchmark::State* state);

/// The `main` of a program of benchmarks: runs those that the arguments select. Returns 0 if all
/// targets are met, 1 with the missed ones on the standard error, 2 for wrong arguments.
int RunAndJudge(int argc, char** argv);

/// Durations of single steps, with their mean and 95th percentile.
class StepTimes {
 public:
  void Add(double seconds) { times_s_.push_back(seconds); }
  double Mean_us() const;
  double P95_us() const;

 private:
  std::vector<double> times_s_;
};

}  // namespace tera::bench
