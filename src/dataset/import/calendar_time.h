#pragma once

#include <optional>
#include <string_view>

#include "core/time.h"

/// Dates and times of day in tables, as ns since 1970 without leap seconds.

namespace tera {

/// Order of a date's numbers: 2026-11-28, 28.11.2026 or 11/28/2026.
enum class DateOrder { kYearFirst, kDayFirst, kMonthFirst };

struct CalendarTime {
  TimeNs t_ns = 0;  ///< UTC if the text has a time zone, otherwise local time
  bool has_zone = false;
  TimeNs ahead_ns = 0;  ///< local time minus UTC, by the time zone
  bool has_clock = false;
};

/// Parses a date with an optional time of day and time zone. Fractions of a second are exact to the
/// nanosecond.
///
/// Model   Accepts ISO 8601 (2026-11-28T12:34:56.789Z, 20261128T123456Z) and these variants: '-',
///         '/', '.' or '_' in the date; a blank or '_' for T; a comma or colon before the fraction;
///         no seconds; the zone as Z, UTC, GMT, +01, +0100 or +01:00; AM or PM; a weekday in front.
///         The day is first if '.' (28.11.2026) or a month name (28-Nov-2026) follows. Also accepts
///         asctime (Sat Nov 28 22:46:10 2026), with UTC or GMT before the year or a zone after it.
///         If the year is last and the separator is '/' or '-', `order` decides which number is the
///         day.
std::optional<CalendarTime> CalendarTimeOf(std::string_view text, std::optional<DateOrder> order);

/// Parses a time of day (9:34:56.789, 12:34 or 123456.789) to ns since midnight. A time zone may
/// follow, as in CalendarTimeOf.
std::optional<CalendarTime> ClockTimeOf(std::string_view text);

/// True for an ambiguous date: the year is last and the separator is '/' or '-'.
bool NeedsDateOrder(std::string_view text);

}  // namespace tera
