#pragma once

#include <string>

#include "core/time.h"

/// Times as texts for other formats. The conversion uses integers, so every digit is exact.

namespace tera {

/// Seconds with `decimals` digits, rounded to nearest, such as "-0.250000000".
std::string SecondsText(TimeNs t_ns, int decimals = 9);

/// Date and time of day in the Gregorian calendar, UTC without leap seconds.
struct CivilTime {
  int year = 1970, month = 1, day = 1;
  int hour = 0, minute = 0, second = 0;
  TimeNs nanosecond = 0;
};
/// Converts nanoseconds since 1970-01-01 00:00:00.
CivilTime CivilTimeOf(TimeNs unix_ns);

/// Rounds to the nearest multiple of 10^-`decimals` s.
TimeNs RoundedTo(TimeNs t_ns, int decimals);

}  // namespace tera
