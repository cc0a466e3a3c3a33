#include "blind/mujoco/sensors/logger.h"

#include <algorithm>
#include <cmath>

namespace tera::blind::mujoco {
namespace {

constexpr double kFirst_s = 0.095;  ///< loggers begin when all sensors have said something

}  // namespace

std::vector<Row> Log(double duration_s, double period_s, const ClockForm& clock,
                     const NoiseForm& noise, std::uint64_t seed, const std::string& name) {
  const Stream stream(seed, name + "/logger");
  const double phase_s = kFirst_s + period_s * stream.Uniform(0, 7);
  std::vector<Row> rows;
  double silent_until_s = 0;
  for (std::uint64_t k = 0;; ++k) {
    const double t_s = phase_s + static_cast<double>(k) * period_s;
    if (t_s > duration_s - 0.02) return rows;
    if (stream.Uniform(k, 0) < noise.bursts_1ps * period_s) {
      silent_until_s = t_s + (0.02 + 0.13 * stream.Uniform(k, 1)) * std::max(1.0, period_s / 0.02);
    }
    if (t_s < silent_until_s || stream.Uniform(k, 2) < noise.lost) continue;
    const double late_s = -clock.lateness_s * std::log(stream.Uniform(k, 3));
    const double stamp_s =
        t_s + clock.OffsetAt(t_s) + late_s + noise.jitter_s * stream.Gaussian(k, 4);
    long long t_ns = std::llround(stamp_s * 1e6) * 1000;
    if (!rows.empty()) t_ns = std::max(t_ns, rows.back().t_ns + 1000);
    rows.push_back({k, t_s, t_ns});
  }
}

Noise::Noise(std::uint64_t seed, const std::string& name, double white, double slow, double tails,
             double memory_s)
    : white_stream_(seed, name + "/white"),
      slow_stream_(seed, name + "/slow"),
      white_(white),
      slow_(slow),
      tails_(tails),
      memory_s_(memory_s),
      drift_(slow * slow_stream_.Gaussian(0, 9)) {}

double Noise::Next(std::uint64_t number, double step_s) {
  const double kept = std::exp(-step_s / memory_s_);
  drift_ = kept * drift_ + slow_ * std::sqrt(1 - kept * kept) * slow_stream_.Gaussian(number);
  const double size = white_stream_.Uniform(number, 1) < tails_ ? 6 * white_ : white_;
  return drift_ + size * white_stream_.Gaussian(number, 0);
}

}  // namespace tera::blind::mujoco
