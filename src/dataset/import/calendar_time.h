#pragma once

#include <optional>
#include <string_view>

#include "core/time.h"

/// Times of the calendar as tables write them, as ns since 1970 without leap seconds.

namespace tera {

/// The number of a date that stands first: 2026-11-28, 28.11.2026, 11/28/2026.
enum class DateOrder { kYearFirst, kDayFirst, kMonthFirst };

struct CalendarTime {
  TimeNs t_ns = 0;  ///< UTC where there is a zone, else as the clock shows
  bool has_zone = false;
  TimeNs ahead_ns = 0;  ///< of UTC, by its zone
  bool has_clock = false;
};

/// A date, and behind it a time of day and a zone where they are there. Any fraction of a second is
/// read, to the nanosecond.
///
/// Model   ISO 8601 (2026-11-28T12:34:56.789Z, 20261128T123456Z) with '-', '/', '.' or '_' in the
///         date, a blank or '_' for T, a comma or a colon before the fraction, no seconds, a zone
///         as Z, UTC, GMT, +01, +0100 or +01:00, AM or PM; a day first before '.' (28.11.2026), or
///         before the name of a month (28-Nov-2026); a weekday before all of it, and asctime's form
///         (Sat Nov 28 22:46:10 2026) with UTC or GMT before the year or a zone behind it. With '/'
///         or '-' and the year last, day and month are told apart by `order` alone.
std::optional<CalendarTime> CalendarTimeOf(std::string_view text, std::optional<DateOrder> order);

/// A time of day, 9:34:56.789, 12:34 or 123456.789, as ns since midnight, with a zone as of
/// CalendarTimeOf.
std::optional<CalendarTime> ClockTimeOf(std::string_view text);

/// Whether a text is a date with '/' or '-' and the year last, whose order has to be said.
bool NeedsDateOrder(std::string_view text);

}  // namespace tera
