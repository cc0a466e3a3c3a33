#pragma once

#include <benchmark/benchmark.h>

#include <string>
#include <vector>

/// How a benchmark says how far its figure is from its target: as the label that ends its line. A
/// program of benchmarks fails if any target is not met (RunAndJudge).

namespace tera::bench {

/// A figure, what it must be, and in what unit. `what` names it.
struct Target {
  std::string what;
  double least_or_most = 0;
  std::string unit;
};

void ExpectAtLeast(const Target& target, double measured, benchmark::State* state);
void ExpectAtMost(const Target& target, double measured, benchmark::State* state);
/// Several of them, and a remark.
struct Measured {
  Target target;
  double figure = 0;
};
void ExpectAtMost(const std::vector<Measured>& figures, const std::string& remark,
                  benchmark::State* state);

/// The `main` of a program of benchmarks: runs those that the arguments ask for. Returns 0 if all
/// targets were met, 1 with their names on the standard error if not, 2 for wrong arguments.
int RunAndJudge(int argc, char** argv);

/// Durations of single steps, for their mean and 95th percentile.
class StepTimes {
 public:
  void Add(double seconds) { times_s_.push_back(seconds); }
  double Mean_us() const;
  double P95_us() const;

 private:
  std::vector<double> times_s_;
};

}  // namespace tera::bench
