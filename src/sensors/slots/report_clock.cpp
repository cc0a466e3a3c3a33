#include "sensors/slots/report_clock.h"

#include <algorithm>
#include <cmath>

#include "sensors/slots/effect_numbers.h"

namespace tera {

double ClockOffset_s(const Effects& effects) {
  return NumberOf(effects, "clock_offset", "offset_s", 0);
}

ReportClock::ReportClock(const Effects& effects, std::uint64_t seed, const std::string& stream_name)
    : offset_ns_(FromSeconds(ClockOffset_s(effects))),
      delay_ns_(FromSeconds(NumberOf(effects, "latency", "delay_s", 0))),
      drift_(NumberOf(effects, "clock_drift", "drift_ppm", 0) * 1e-6),
      jitter_s_(NumberOf(effects, "latency", "jitter_s", 0)),
      jitter_(seed, stream_name + "/latency") {}

ReportClock::Times ReportClock::Next(std::int64_t k, TimeNs t_ns) {
  Times times;
  times.late_ns = delay_ns_;
  if (jitter_s_ > 0) {
    times.late_ns +=
        FromSeconds(-jitter_s_ * std::log(jitter_.Uniform(static_cast<std::uint64_t>(k))));
  }
  times.t_ns = Duration(t_ns) + offset_ns_ + times.late_ns;
  if (last_ns_ && times.t_ns <= *last_ns_) {
    times.late_ns += *last_ns_ + 1 - times.t_ns;
    times.t_ns = *last_ns_ + 1;
  }
  last_ns_ = times.t_ns;
  return times;
}

TimeNs ReportClock::Duration(TimeNs d_ns) const {
  return d_ns + std::llround(drift_ * static_cast<double>(d_ns));
}

}  // namespace tera
