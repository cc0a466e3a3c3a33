#include "verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace tera::bench {
namespace {

constexpr double kMicrosecondsPerSecond = 1e6;

void Say(const Target& target, const char* relation, double measured, bool met,
         benchmark::State* state) {
  state->SetLabel(fmt::format("{} {:.2f}{}, target {} {:g}{}: {}", target.what, measured,
                              target.unit, relation, target.least_or_most, target.unit,
                              met ? "met" : "not met"));
}

}  // namespace

void ExpectAtLeast(const Target& target, double measured, benchmark::State* state) {
  Say(target, ">=", measured, measured >= target.least_or_most, state);
}

void ExpectAtMost(const Target& target, double measured, benchmark::State* state) {
  Say(target, "<=", measured, measured <= target.least_or_most, state);
}

double StepTimes::Mean_us() const {
  const double sum_s = std::accumulate(times_s_.begin(), times_s_.end(), 0.0);
  return kMicrosecondsPerSecond * sum_s / static_cast<double>(times_s_.size());
}

double StepTimes::P95_us() const {
  std::vector<double> sorted = times_s_;
  std::sort(sorted.begin(), sorted.end());
  return kMicrosecondsPerSecond * sorted[sorted.size() * 95 / 100];
}

}  // namespace tera::bench
