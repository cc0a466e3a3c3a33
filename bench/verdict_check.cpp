#include "verdict.h"

// Two benchmarks that measure nothing, one of which misses its target: run by ctest, to see that a
// program of benchmarks fails then and only then.

namespace tera::bench {
namespace {

void MeetsItsTarget(benchmark::State& state) {
  for (auto _ : state) {
  }
  ExpectAtLeast({"seven", 6, ""}, 7, &state);
  ExpectAtMost({{{"seven", 8, ""}, 7}, {{"six", 6, ""}, 6}}, "", &state);
}
BENCHMARK(MeetsItsTarget)->Iterations(1);

void MissesItsTarget(benchmark::State& state) {
  for (auto _ : state) {
  }
  ExpectAtMost({{{"seven", 8, ""}, 7}, {{"nine", 8, ""}, 9}}, "", &state);
}
BENCHMARK(MissesItsTarget)->Iterations(1);

}  // namespace
}  // namespace tera::bench
