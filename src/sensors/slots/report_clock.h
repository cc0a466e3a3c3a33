#pragma once

#include <optional>
#include <string>

#include "core/random.h"
#include "core/time.h"
#include "core/types/effects.h"

namespace tera {

/// Offset of the sensor's clock, `clock_offset`; positive is ahead of true time.
double ClockOffset_s(const Effects& effects);

/// Slot `sensor_timing`: time stamps of a sensor's measurements.
///
/// Model   t + offset + ppm 1e-6 t + d. The terms come from `clock_offset`, `clock_drift` (t since
///         the start), and `latency` with d = delay + Exp(jitter), for measurements stamped on
///         arrival. The order of measurements is kept: a measurement that would overtake its
///         predecessor is stamped one nanosecond after it. The sampling times do not change.
/// Omits   Effect of clock drift on the sensor's rate; steps of a clock that is set.
/// Source  GPS time is ahead of UTC by the leap seconds since 1980, 18 s since 2017 (IERS Bulletin
///         C 52).
class ReportClock {
 public:
  ReportClock(const Effects& effects, std::uint64_t seed, const std::string& stream_name);
  struct Times {
    TimeNs t_ns = 0;     ///< time stamp
    TimeNs late_ns = 0;  ///< additional delay of availability
  };
  /// Times of measurement `k`, taken at `t_ns`. Call it in the order of the sample times.
  Times Next(std::int64_t k, TimeNs t_ns);
  /// Duration `d_ns` as this clock counts it.
  TimeNs Duration(TimeNs d_ns) const;

 private:
  TimeNs offset_ns_, delay_ns_;
  double drift_, jitter_s_;
  Stream jitter_;
  std::optional<TimeNs> last_ns_;
};

/// Sets the reported times of a sample.
template <typename Sample>
void Restamp(const ReportClock::Times& times, Sample* sample) {
  sample->t_ns = times.t_ns;
  sample->t_available_ns += times.late_ns;
}

}  // namespace tera
