#pragma once

#include <optional>
#include <string_view>

#include "core/time.h"

/// Dates and times of day in logs, as ns since 1970 without leap seconds.

namespace tera {

/// A date in the years 1970 to 2200; nullopt if invalid.
std::optional<TimeNs> DayOf(int year, int month, int day);

/// Parses "2026/05/01" or "2026-05-01".
std::optional<TimeNs> DateOfText(std::string_view text);

/// Parses "12:34:56.789" exactly, with up to nine decimals. Second 60 is allowed, for a leap
/// second.
std::optional<TimeNs> TimeOfDayText(std::string_view text);

/// Parses a number of seconds such as "345600.125", exact to the nanosecond.
std::optional<TimeNs> SecondsOfText(std::string_view text);

/// Start of a GPS week, in GPS time.
TimeNs GpsWeek(int week);

}  // namespace tera
