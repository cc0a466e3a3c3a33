#include <benchmark/benchmark.h>

#include "core/stopwatch.h"
#include "dig_site.h"
#include "recorded_motion.h"
#include "verdict.h"

// The soil alone, under a machine that moves as it did in a whole simulation.

namespace tera::bench {
namespace {

constexpr int kSteps = 10000;

void Work(benchmark::State& state, const std::string& name, double limit_us) {
  const RecordedMotion motion = Record(name, kSteps);
  const ShippedScenario loaded = Load(name);
  Soil& soil = *loaded.scenario.soil;
  const int machine =
      soil.AddMachine(loaded.scenario.machines.front().placement.model.ground_tools);
  StepTimes act, flow, both;
  std::size_t next = 0;
  for (auto _ : state) {
    const RecordedMotion::Moment& moment = motion.moments[next++];
    double act_s = 0, flow_s = 0;
    {
      const Stopwatch watch(&act_s);
      benchmark::DoNotOptimize(
          soil.Act(machine, {&moment.links, moment.gear_rate_radps}, motion.dt_s));
    }
    {
      const Stopwatch watch(&flow_s);
      soil.Flow(motion.dt_s);
    }
    act.Add(act_s);
    flow.Add(flow_s);
    both.Add(act_s + flow_s);
  }
  state.counters["act_us"] = act.Mean_us();
  state.counters["flow_us"] = flow.Mean_us();
  state.counters["p95_us"] = both.P95_us();
  ExpectAtMost({"soil alone", limit_us, " us"}, both.Mean_us(), &state);
}

void SoilUnderBucket(benchmark::State& state) { Work(state, "quickstart", 200); }
BENCHMARK(SoilUnderBucket)->Iterations(kSteps)->Unit(benchmark::kMicrosecond);

void SoilUnderTracks(benchmark::State& state) { Work(state, "drive_three_soils", 300); }
BENCHMARK(SoilUnderTracks)->Iterations(kSteps)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace tera::bench
