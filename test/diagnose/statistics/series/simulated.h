#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "core/random.h"
#include "diagnose/statistics/series/noise_model.h"
#include "diagnose/statistics/series/series.h"

namespace tera {

/// AR(1) noise of coefficient 0.95 with heavy tails: what the tests have to hold under.
inline NoiseModel StubbornNoise() { return {.ar = {0.95}, .scale = 1, .dof = 4}; }

inline Series NoiseSeries(const NoiseModel& noise, std::size_t size, const Stream& stream) {
  return MakeSeries(0.01, SimulateNoise(noise, size, stream));
}

/// Loses `share` of the samples in bursts of 1 to 10.
inline Series WithDropouts(Series series, double share, const Stream& stream) {
  for (std::size_t k = 0; k < series.size(); ++k) {
    if (stream.Uniform(k, 7) > share / 5.5) continue;
    const auto length = 1 + static_cast<std::size_t>(10 * stream.Uniform(k, 8));
    for (std::size_t i = k; i < std::min(k + length, series.size()); ++i) {
      series.valid[i] = 0;
      series.value[i] = 0;
    }
  }
  return series;
}

/// A lever as it is moved: held for 0.2 to 1 s at one of many values, at rest a third of the time.
inline Series LeverSeries(std::size_t size, const Stream& stream) {
  std::vector<double> value(size);
  double held = 0;
  std::size_t next = 0;
  for (std::size_t k = 0; k < size; ++k) {
    if (k == next) {
      next = k + 20 + static_cast<std::size_t>(80 * stream.Uniform(k, 1));
      held = stream.Uniform(k, 2) < 1.0 / 3 ? 0 : 2 * stream.Uniform(k, 3) - 1;
    }
    value[k] = (k > 0 ? 0.8 * value[k - 1] : 0) + 0.2 * held;
  }
  return MakeSeries(0.01, std::move(value));
}

}  // namespace tera
