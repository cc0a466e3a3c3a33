#include <benchmark/benchmark.h>

#include <cmath>
#include <string>
#include <vector>

#include "diagnose/statistics/hypothesis_tests/change_points.h"
#include "diagnose/statistics/regime/curve_shape.h"
#include "diagnose/statistics/regime/partialling.h"
#include "diagnose/statistics/series/simulated.h"
#include "diagnose/statistics/series/whitening.h"

// One channel of a recording of ten minutes at 100 Hz against twenty variables.

namespace tera::bench {
namespace {

constexpr std::size_t kSamples = 60000;
constexpr int kVariables = 20;

/// A lever that moves every 0.6 s.
Series Lever(const Stream& stream) {
  std::vector<double> value(kSamples);
  for (std::size_t k = 1; k < kSamples; ++k) {
    value[k] = 0.8 * value[k - 1] + 0.2 * (2 * stream.Uniform(k / 60) - 1);
  }
  return MakeSeries(0.01, std::move(value));
}

struct Channel {
  std::vector<RegimeVariable> variables;
  Series residual;

  Channel() {
    for (int v = 0; v < kVariables; ++v) {
      const std::string name = "variable" + std::to_string(v);
      variables.push_back({name, Lever(Stream(1, name))});
    }
    const NoiseModel noise{.ar = {1.2, -0.3, 0.05}, .dof = 4};
    residual = MakeSeries(0.01, SimulateNoise(noise, kSamples, Stream(1, "noise")));
    for (std::size_t k = 0; k < kSamples; ++k) {
      residual.value[k] += variables[3].series.value[k] + std::abs(variables[5].series.value[k]);
    }
  }
};

const Channel& TheChannel() {
  static const Channel channel;
  return channel;
}

void Noise(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(FitNoise(TheChannel().residual));
}
BENCHMARK(Noise)->Unit(benchmark::kMillisecond);

void TimeOfMismatch(benchmark::State& state) {
  const NoiseModel noise = FitNoise(TheChannel().residual);
  const Series innovations = Whiten(noise, TheChannel().residual).scaled;
  for (auto _ : state) benchmark::DoNotOptimize(FindChangePoints(innovations, noise.dof));
}
BENCHMARK(TimeOfMismatch)->Unit(benchmark::kMillisecond);

void RegimeOfMismatch(benchmark::State& state) {
  const Channel& channel = TheChannel();
  const NoiseModel noise = FitNoise(channel.residual);
  std::size_t steps = 0;
  for (auto _ : state) {
    steps = SelectRegimes(channel.residual, noise, channel.variables, {}, Stream(1, "shifts"))
                .steps.size();
  }
  state.counters["variables_taken"] = static_cast<double>(steps);
  state.counters["order"] = static_cast<double>(noise.order());
}
BENCHMARK(RegimeOfMismatch)->Unit(benchmark::kMillisecond);

void Curve(benchmark::State& state) {
  const Channel& channel = TheChannel();
  const NoiseModel noise = FitNoise(channel.residual);
  for (auto _ : state) {
    benchmark::DoNotOptimize(ClassifyCurve(FitRegimeCurve(
        channel.residual, noise, Eigen::MatrixXd(), channel.variables[3], Stream(1, "band"))));
  }
}
BENCHMARK(Curve)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace tera::bench
