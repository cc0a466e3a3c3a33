#pragma once

#include <cmath>
#include <cstdint>

/// Time is a signed 64-bit count of nanoseconds since the start of the scenario (or, in a real
/// recording, since its own epoch). Times are computed from counts, never accumulated in doubles.

namespace tera {

using TimeNs = std::int64_t;

inline constexpr TimeNs kNsPerSecond = 1'000'000'000;

inline double ToSeconds(TimeNs t_ns) { return static_cast<double>(t_ns) * 1e-9; }

/// Nearest nanosecond to `t_s`.
inline TimeNs FromSeconds(double t_s) { return static_cast<TimeNs>(std::llround(t_s * 1e9)); }

/// When the samples of something periodic are due: sample k at `start_ns + k / rate_hz`, rounded
/// to the nanosecond for each k alone, so that 30 Hz does not drift.
struct SampleClock {
  double rate_hz = 1.0;
  TimeNs start_ns = 0;

  TimeNs Due(std::int64_t k) const {
    return start_ns + static_cast<TimeNs>(std::llround(static_cast<double>(k) * 1e9 / rate_hz));
  }
  TimeNs Period() const { return Due(1) - Due(0); }
};

}  // namespace tera
