#pragma once

#include <optional>
#include <string_view>

#include "core/time.h"

/// Dates and times of day of logs, as ns since 1970 without leap seconds.

namespace tera {

/// Of a date; nothing where there is no such day from 1970 to 2200.
std::optional<TimeNs> DayOf(int year, int month, int day);

/// Of "2026/05/01" or "2026-05-01".
std::optional<TimeNs> DateOfText(std::string_view text);

/// Of "12:34:56.789", up to nine digits behind the point, exactly; second 60 is that of a leap.
std::optional<TimeNs> TimeOfDayText(std::string_view text);

/// Of a number of seconds as text, "345600.125", exactly to the nanosecond.
std::optional<TimeNs> SecondsOfText(std::string_view text);

/// The beginning of a week of GPS time.
TimeNs GpsWeek(int week);

}  // namespace tera
