#pragma once

#include <cmath>
#include <cstdint>

/// Time is a signed 64-bit count of nanoseconds since the start of the scenario, or since the epoch
/// of a real recording. Sample times are computed from sample indices, never by adding doubles.

namespace tera {

using TimeNs = std::int64_t;

inline constexpr TimeNs kNsPerSecond = 1'000'000'000;

inline double ToSeconds(TimeNs t_ns) { return static_cast<double>(t_ns) * 1e-9; }

/// Nearest nanosecond to `t_s`.
inline TimeNs FromSeconds(double t_s) { return static_cast<TimeNs>(std::llround(t_s * 1e9)); }

/// Sample times of a periodic process: sample k is at `start_ns + k / rate_hz`. Each time is
/// rounded to a nanosecond on its own, so rates such as 30 Hz do not drift.
struct SampleClock {
  double rate_hz = 1.0;
  TimeNs start_ns = 0;

  TimeNs Due(std::int64_t k) const {
    return start_ns + static_cast<TimeNs>(std::llround(static_cast<double>(k) * 1e9 / rate_hz));
  }
  TimeNs Period() const { return Due(1) - Due(0); }
};

}  // namespace tera
