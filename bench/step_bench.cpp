#include <benchmark/benchmark.h>

#include "core/stopwatch.h"
#include "dig_site.h"
#include "sim/simulation.h"
#include "verdict.h"

// One step of the simulation, 500 of them a simulated second.

namespace tera::bench {
namespace {

/// Steps `name` from its start; iterations are steps.
void Step(benchmark::State& state, const std::string& name, double limit_us) {
  ShippedScenario loaded = Load(name);
  Simulation simulation(loaded.scenario);
  const double physics_before_s = simulation.physics_wall_s();
  const double soil_before_s = simulation.soil_wall_s();
  StepTimes whole, soil;
  for (auto _ : state) {
    const double soil_s = simulation.soil_wall_s();
    double step_s = 0;
    {
      const Stopwatch watch(&step_s);
      simulation.Step();
    }
    whole.Add(step_s);
    soil.Add(simulation.soil_wall_s() - soil_s);
  }
  const auto each_us = [&](double sum_s) {
    return 1e6 * sum_s / static_cast<double>(state.iterations());
  };
  state.counters["p95_us"] = whole.P95_us();
  state.counters["physics_us"] = each_us(simulation.physics_wall_s() - physics_before_s);
  state.counters["soil_us"] = each_us(simulation.soil_wall_s() - soil_before_s);
  state.counters["soil_p95_us"] = soil.P95_us();
  ExpectAtMost({"soil mean", limit_us, " us"}, soil.Mean_us(), &state);
}

/// Physics and soil for 20 s: two dig cycles and the beginning of a third.
void DigStep(benchmark::State& state) { Step(state, "quickstart", 200); }
BENCHMARK(DigStep)->Iterations(10000)->Unit(benchmark::kMicrosecond);

/// Physics and soil, tracks over dirt, gravel and sand.
void DriveStep(benchmark::State& state) { Step(state, "drive_three_soils", 300); }
BENCHMARK(DriveStep)->Iterations(10000)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace tera::bench
