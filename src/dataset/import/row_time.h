#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/config/config.h"
#include "core/time.h"
#include "dataset/import/calendar_time.h"
#include "dataset/import/column_mapping.h"
#include "dataset/import/row_table.h"

namespace tera {

/// Definition of a table's row times, from a mapping's `time:`.
struct RowTime {
  enum class Form {
    kNumber,    ///< `number` gives seconds, or is a column of stamps
    kInterval,  ///< the first row is at `number`, a constant; each next one `interval_s` later
    kDate,      ///< dates in `date`, with the time of day in `clock` unless that is empty
    kClock,     ///< times of day in `clock`; one that goes back by half a day is of the next day
    kGpsWeek,   ///< `number` gives seconds of the week of GPS time in `week`
  };
  Form form = Form::kNumber;
  ColumnMapping number;
  double interval_s = 0;
  std::string date, clock, week;
  std::optional<DateOrder> order;
  double wraps_at = 0;   ///< number at which the column wraps to 0; 0: no wrap
  TimeNs ahead_ns = 0;   ///< local time minus UTC, for texts without a zone
  TimeNs offset_ns = 0;  ///< for all forms except numbers, which have their own

  /// All columns of the time.
  std::vector<std::string> Columns() const;
};

/// The period of a counter that wraps to 0, if `after` then follows `before` by about `step`.
/// Candidates are 2^16, 2^24, 2^31 or 2^32 of its units or of thousandths or millionths of these,
/// an hour, a day or a week. Nothing if none fits.
std::optional<double> TurnOfCounter(double before, double after, double step);

/// Reads `{column:, unit:, scale:, offset:, wraps_at:}`, `{sum:}`, `{interval:, unit:, offset:}`,
/// `{date:, clock:, order:, zone:, offset:}` or `{week:, column:, unit:, offset:}`. A column of
/// stamps, in bags and logs of known form (`has_stamps`), needs no unit.
RowTime ReadRowTime(const ConfigMap& time, bool has_stamps);

/// Whether a mapping's `time` is still to be filled in, as in a suggestion for an unknown time. A
/// mapping with it is faulty.
bool IsTimeToFillIn(const ConfigMap& holder);

/// Times of the rows of one table.
class RowTimes {
 public:
  /// Times of day count days, and wrapping counters count periods, over the rows that `counts`
  /// selects, or over all rows. Throws InputError for a missing column.
  RowTimes(const RowTable& table, const RowTime& time,
           const std::function<bool(std::size_t row)>& counts = nullptr);

  /// The time of a row: exact for stamps, calendar texts and plain digits, else within a double's
  /// precision. Throws InputError for a row without a time.
  TimeNs At(std::size_t row) const;
  /// TurnOfCounter of a one-column time that goes back after `before_ns`.
  std::optional<double> TurnAt(std::size_t row, TimeNs before_ns, TimeNs step_ns) const;
  /// The column to name for an unsuitable time.
  std::size_t place() const { return places_.empty() ? 0 : places_.front(); }

 private:
  /// The time without wraps.
  TimeNs WithoutTurns(std::size_t row) const;
  TimeNs OfNumber(std::size_t row) const;
  TimeNs OfDate(std::size_t row) const;
  TimeNs OfGpsWeek(std::size_t row) const;
  TimeNs ClockAt(std::size_t row, std::size_t place, TimeNs ahead_ns) const;
  /// Refuses a calendar text in place of a number with its own message.
  void RefuseTextOfCalendar(std::size_t row, std::size_t place) const;
  std::string_view TextAt(std::size_t row, std::size_t place, const char* need) const;
  /// The time within its period, for wrapping times; nothing for a row without a time.
  std::optional<TimeNs> WithinTurn(std::size_t row) const;
  void CountTurns(const std::function<bool(std::size_t row)>& counts);

  const RowTable& table_;
  const RowTime& time_;
  MappedColumn number_;
  std::vector<std::size_t> places_;   ///< indices of the columns of `time_`
  TimeNs turn_ns_ = 0;                ///< period of wrapping times; 0: no wrap
  std::vector<std::uint32_t> turns_;  ///< periods since the first row
};

}  // namespace tera
