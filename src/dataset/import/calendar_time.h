#pragma once

#include <optional>
#include <string_view>

#include "core/time.h"

/// Calendar times of tables, as ns since 1970 without leap seconds.

namespace tera {

/// First number of a date: 2026-11-28, 28.11.2026, 11/28/2026.
enum class DateOrder { kYearFirst, kDayFirst, kMonthFirst };

struct CalendarTime {
  TimeNs t_ns = 0;  ///< UTC if there is a zone, else local time
  bool has_zone = false;
  TimeNs ahead_ns = 0;  ///< local time minus UTC, from the zone
  bool has_clock = false;
};

/// Parses a date with an optional time of day and zone. Fractions of a second are exact to the
/// nanosecond.
///
/// Model   ISO 8601 (2026-11-28T12:34:56.789Z, 20261128T123456Z). Variants: '-', '/', '.' or '_' in
///         the date; a blank or '_' for T; a comma or a colon before the fraction; no seconds; a
///         zone as Z, UTC, GMT, +01, +0100 or +01:00; AM or PM. The day comes first before '.'
///         (28.11.2026), or before the name of a month (28-Nov-2026). A weekday may precede. Also
///         asctime's form (Sat Nov 28 22:46:10 2026) with UTC or GMT before the year or a zone
///         after it. With '/' or '-' and the year last, `order` alone separates day and month.
std::optional<CalendarTime> CalendarTimeOf(std::string_view text, std::optional<DateOrder> order);

/// Parses a time of day, 9:34:56.789, 12:34 or 123456.789, as ns since midnight, with a zone as in
/// CalendarTimeOf.
std::optional<CalendarTime> ClockTimeOf(std::string_view text);

/// Whether a text is a date with '/' or '-' and the year last, whose order is ambiguous.
bool NeedsDateOrder(std::string_view text);

}  // namespace tera
