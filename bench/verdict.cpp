#include "verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <numeric>

namespace tera::bench {
namespace {

constexpr double kMicrosecondsPerSecond = 1e6;

/// Targets missed so far, in their printed form.
std::vector<std::string>& Missed() {
  static std::vector<std::string> missed;
  return missed;
}

std::string Said(const Target& target, const char* relation, double measured, bool met) {
  std::string said =
      fmt::format("{} {:.2f}{}, target {} {:g}{}: {}", target.what, measured, target.unit, relation,
                  target.least_or_most, target.unit, met ? "met" : "not met");
  if (!met) Missed().push_back(said);
  return said;
}

std::string AtMost(const Target& target, double measured) {
  return Said(target, "<=", measured, measured <= target.least_or_most);
}

}  // namespace

void ExpectAtLeast(const Target& target, double measured, benchmark::State* state) {
  state->SetLabel(Said(target, ">=", measured, measured >= target.least_or_most));
}

void ExpectAtMost(const Target& target, double measured, benchmark::State* state) {
  state->SetLabel(AtMost(target, measured));
}

void ExpectAtMost(const std::vector<Measured>& figures, const std::string& remark,
                  benchmark::State* state) {
  std::string said;
  for (const auto& [target, figure] : figures) {
    said += (said.empty() ? "" : "; ") + AtMost(target, figure);
  }
  state->SetLabel(remark.empty() ? said : said + "; " + remark);
}

int RunAndJudge(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  for (const std::string& said : Missed()) fmt::print(stderr, "missed: {}\n", said);
  return Missed().empty() ? 0 : 1;
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
