#pragma once

#include <optional>
#include <string>

#include "core/random.h"
#include "core/time.h"
#include "core/types/effects.h"

namespace tera {

/// By how much `clock_offset` puts the times that a sensor writes ahead of the true ones.
double ClockOffset_s(const Effects& effects);

/// Slot `sensor_timing`: what time a sensor writes on a measurement.
///
/// Model   t + offset + ppm 1e-6 t + d: `clock_offset`, `clock_drift` (t since the start), and
///         `latency` d = delay + Exp(jitter), for a measurement that gets its stamp only where it
///         arrives. Measurements stay in their order: one that would overtake arrives a nanosecond
///         after its predecessor. The sensor samples when it did before.
/// Omits   the sensor's own rate, which a clock that drifts drives too; steps of a clock that is
///         set.
/// Source  GPS time is ahead of UTC by the leap seconds since 1980, 18 s since 2017 (IERS
///         Bulletin C 52).
class ReportClock {
 public:
  ReportClock(const Effects& effects, std::uint64_t seed, const std::string& stream_name);
  struct Times {
    TimeNs t_ns = 0;     ///< as written
    TimeNs late_ns = 0;  ///< after it could be had otherwise
  };
  /// Measurement `k` that was valid at `t_ns`; in the order of their times.
  Times Next(std::int64_t k, TimeNs t_ns);
  /// Duration `d_ns` as this clock measures it.
  TimeNs Duration(TimeNs d_ns) const;

 private:
  TimeNs offset_ns_, delay_ns_;
  double drift_, jitter_s_;
  Stream jitter_;
  std::optional<TimeNs> last_ns_;
};

/// Gives a sample the times that its sensor writes.
template <typename Sample>
void Restamp(const ReportClock::Times& times, Sample* sample) {
  sample->t_ns = times.t_ns;
  sample->t_available_ns += times.late_ns;
}

}  // namespace tera
