#include "dataset/export/stamp_text.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdlib>

namespace tera {
namespace {

constexpr int kDecimalsOfNanoseconds = 9;

TimeNs UnitOf(int decimals) {
  TimeNs unit_ns = 1;
  for (int k = decimals; k < kDecimalsOfNanoseconds; ++k) unit_ns *= 10;
  return unit_ns;
}

}  // namespace

TimeNs RoundedTo(TimeNs t_ns, int decimals) {
  const TimeNs unit_ns = UnitOf(decimals);
  const TimeNs half_ns = t_ns < 0 ? -unit_ns / 2 : unit_ns / 2;
  return (t_ns + half_ns) / unit_ns * unit_ns;
}

std::string SecondsText(TimeNs t_ns, int decimals) {
  const TimeNs rounded_ns = RoundedTo(t_ns, decimals);
  const TimeNs whole_s = std::abs(rounded_ns / kNsPerSecond);
  const std::string sign = rounded_ns < 0 ? "-" : "";
  if (decimals == 0) return fmt::format("{}{}", sign, whole_s);
  return fmt::format("{}{}.{:0{}}", sign, whole_s,
                     std::abs(rounded_ns % kNsPerSecond) / UnitOf(decimals), decimals);
}

CivilTime CivilTimeOf(TimeNs unix_ns) {
  using std::chrono::nanoseconds;
  const std::chrono::sys_time<nanoseconds> time{nanoseconds(unix_ns)};
  const auto day = std::chrono::floor<std::chrono::days>(time);
  const std::chrono::year_month_day date(day);
  const std::chrono::hh_mm_ss<nanoseconds> clock(time - day);
  return {static_cast<int>(date.year()),
          static_cast<int>(static_cast<unsigned>(date.month())),
          static_cast<int>(static_cast<unsigned>(date.day())),
          static_cast<int>(clock.hours().count()),
          static_cast<int>(clock.minutes().count()),
          static_cast<int>(clock.seconds().count()),
          clock.subseconds().count()};
}

}  // namespace tera
