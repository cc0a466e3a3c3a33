#include "blind/plant/measurement.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tera::blind {
namespace {

constexpr double kPeriod_s = 0.01;

/// Student-t of unit variance, as a normal over the root of a sum of squares.
double HeavyTailed(const Stream& stream, std::uint64_t k, double dof) {
  double sum = 0;
  const int n = static_cast<int>(std::lround(dof));
  for (int i = 0; i < n; ++i) sum += std::pow(stream.Gaussian(k, 1 + static_cast<unsigned>(i)), 2);
  return stream.Gaussian(k) / std::sqrt(sum / n) * std::sqrt((n - 2.0) / n);
}

double Rounded(double x, double step) { return std::round(x / step) * step; }

/// Coloured noise, engine and outliers of one axis.
std::vector<double> RateNoise(std::size_t count, const EncoderNoise& noise, const Stream& stream) {
  std::vector<double> out(count);
  double memory = 0;
  const double innovation = noise.rate_radps * std::sqrt(1 - noise.memory * noise.memory);
  const double phase = 2 * std::numbers::pi * stream.Uniform(0, 40);
  for (std::size_t k = 0; k < count; ++k) {
    memory = noise.memory * memory + innovation * HeavyTailed(stream, k, noise.dof);
    const double turns = noise.engine_hz * kPeriod_s * static_cast<double>(k);
    out[k] = memory + noise.engine_radps * std::sin(2 * std::numbers::pi * turns + phase);
    if (stream.Uniform(k, 41) < noise.outlier) {
      out[k] += 10 * noise.rate_radps * stream.Gaussian(k, 42);
    }
  }
  return out;
}

/// Which samples do not come: runs that begin by chance.
std::vector<bool> Lost(std::size_t count, double share, const Stream& stream) {
  std::vector<bool> lost(count, false);
  for (std::size_t k = 0; k < count; ++k) {
    if (stream.Uniform(k, 50) >= share / 3) continue;
    const auto run = static_cast<std::size_t>(1 + 5 * stream.Uniform(k, 51));
    for (std::size_t i = k; i < std::min(count, k + run); ++i) lost[i] = true;
  }
  return lost;
}

}  // namespace

EncoderNoise DrawNoise(const Stream& stream) {
  const auto between = [&](std::uint64_t k, double low, double high) {
    return low + (high - low) * stream.Uniform(k);
  };
  EncoderNoise noise;
  noise.rate_radps = between(0, 0.0025, 0.0045);
  noise.memory = between(1, 0.1, 0.8);
  noise.dof = std::round(between(2, 3.6, 7.4));
  noise.engine_radps = between(3, 0.0, 0.0015);
  noise.engine_hz = between(4, 26, 38);
  noise.lost = between(5, 0.0, 0.04);
  noise.late_s = between(6, 0.0, 0.002);
  return noise;
}

std::vector<double> SampleTimes(double duration_s, const EncoderNoise& noise,
                                const Stream& stream) {
  std::vector<double> times;
  const double phase_s = kPeriod_s * stream.Uniform(0);
  for (std::uint64_t k = 0;; ++k) {
    const double jitter_s = std::clamp(noise.jitter_s * stream.Gaussian(k, 1), -0.003, 0.003);
    const double t_s = phase_s + 0.005 + kPeriod_s * static_cast<double>(k) + jitter_s;
    if (t_s >= duration_s - 0.02) return times;
    times.push_back(t_s);
  }
}

EncoderRows Measure(const Motion& motion, const std::vector<std::size_t>& axes,
                    const EncoderNoise& noise, const Stream& stream) {
  EncoderRows rows;
  rows.axes = axes;
  const std::size_t count = motion.t_s.size();
  const std::vector<bool> lost = Lost(count, noise.lost, stream);
  std::array<std::vector<double>, kAxes> rate_noise;
  for (const std::size_t i : axes) {
    rate_noise[i] = RateNoise(
        count, noise, Stream(static_cast<std::uint64_t>(1e15 * stream.Uniform(i, 60)), "rate"));
  }
  for (std::size_t k = 0; k < count; ++k) {
    if (lost[k]) continue;
    AxisValues q{}, w{};
    for (const std::size_t i : axes) {
      const auto lane = static_cast<std::uint32_t>(70 + i);
      q[i] = Rounded(motion.q_rad[k][i] + noise.angle_rad * stream.Gaussian(k, lane),
                     noise.angle_step_rad);
      w[i] = Rounded(motion.w_radps[k][i] + rate_noise[i][k], noise.rate_step_radps);
    }
    rows.t_ns.push_back(std::llround((motion.t_s[k] + noise.late_s) * 1e6) * 1000);
    rows.q_rad.push_back(q);
    rows.w_radps.push_back(w);
    rows.sample.push_back(k);
  }
  return rows;
}

}  // namespace tera::blind
