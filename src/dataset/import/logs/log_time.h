#pragma once

#include <optional>
#include <string_view>

#include "core/time.h"

/// Dates and times of day of logs, as ns since 1970 without leap seconds.

namespace tera {

/// A date from 1970 to 2200; nothing for an invalid one.
std::optional<TimeNs> DayOf(int year, int month, int day);

/// "2026/05/01" or "2026-05-01".
std::optional<TimeNs> DateOfText(std::string_view text);

/// "12:34:56.789", with up to nine decimals, exactly. Second 60 is a leap second.
std::optional<TimeNs> TimeOfDayText(std::string_view text);

/// A number of seconds as text, "345600.125", exact to the nanosecond.
std::optional<TimeNs> SecondsOfText(std::string_view text);

/// The beginning of a week of GPS time.
TimeNs GpsWeek(int week);

}  // namespace tera
