#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/random.h"
#include "core/units.h"
#include "diagnose/statistics/series/noise_model.h"
#include "diagnose/statistics/series/series.h"

namespace tera {

/// A series of values; non-finite ones are gaps.
inline Series MakeSeries(double period_s, std::vector<double> value) {
  Series series{period_s, std::move(value), {}};
  series.valid.resize(series.size());
  for (std::size_t k = 0; k < series.size(); ++k) {
    series.valid[k] = std::isfinite(series.value[k]);
    if (!series.valid[k]) series.value[k] = 0;
  }
  return series;
}

/// A draw from Student's t by a generalisation of Box–Muller.
/// Source  Bailey 1994, "Polar generation of random variates with the t-distribution".
inline double StudentDraw(const Stream& stream, std::size_t index, double dof) {
  const double u = stream.Uniform(index, 0), v = stream.Uniform(index, 1);
  return std::sqrt(dof * (std::pow(u, -2 / dof) - 1)) * std::cos(2 * kPi * v);
}

/// `count` samples of the process, drawn from `stream` after its start has decayed.
inline std::vector<double> SimulateNoise(const NoiseModel& noise, std::size_t count,
                                         const Stream& stream) {
  const std::size_t start = noise.ar.empty() ? 0 : 1000 + 20 * noise.order();
  std::vector<double> x(start + count, 0.0);
  for (std::size_t k = 0; k < x.size(); ++k) {
    x[k] = noise.scale * StudentDraw(stream, k, noise.dof);
    for (std::size_t i = 0; i < std::min(noise.order(), k); ++i) x[k] += noise.ar[i] * x[k - 1 - i];
  }
  x.erase(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(start));
  for (double& value : x) value += noise.mean;
  return x;
}

/// AR(1) noise of coefficient 0.95 with heavy tails, under which the tests must hold their level.
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

/// A realistic lever: held for 0.2 to 1 s at one of many values, at rest a third of the time.
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
