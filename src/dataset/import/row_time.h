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

/// Source of the row times, from the key `time` of a mapping.
struct RowTime {
  enum class Form {
    kNumber,    ///< `number` is in seconds or is a column of stamps
    kInterval,  ///< the first row is at the constant `number`, and each next row `interval_s` later
    kDate,      ///< a date in column `date`; the time of day is there too or in column `clock`
    kClock,  ///< a time of day in column `clock`; a step back by half a day or more starts the next
             ///< day
    kGpsWeek,  ///< GPS week in column `week`; `number` is in seconds of the week
  };
  Form form = Form::kNumber;
  ColumnMapping number;
  double interval_s = 0;
  std::string date, clock, week;
  std::optional<DateOrder> order;
  double wraps_at = 0;   ///< value at which the column wraps to 0; 0: it does not wrap
  TimeNs ahead_ns = 0;   ///< local time minus UTC, for texts without a time zone
  TimeNs offset_ns = 0;  ///< added to all forms except kNumber, whose ColumnMapping has an offset

  std::vector<std::string> Columns() const;
};

/// Guesses the period of a counter that wraps to 0. Returns the period for which `after` follows
/// `before` by about `step`; nullopt if none fits. Candidates are 2^16, 2^24, 2^31 and 2^32 units,
/// or 2^16, 2^31 and 2^32 thousandths or millionths of a unit; also a minute, an hour, a day and a
/// week.
std::optional<double> TurnOfCounter(double before, double after, double step);

/// Reads one of the forms `{column:, unit:, scale:, offset:, wraps_at:}`, `{sum:}`, `{interval:,
/// unit:, offset:}`, `{date:, clock:, order:, zone:, offset:}` and `{week:, column:, unit:,
/// offset:}`. With `has_stamps`, a column of stamps needs no unit. Bags and logs of known format
/// have such columns.
RowTime ReadRowTime(const ConfigMap& time, bool has_stamps);

/// True if `time` is still the placeholder that a suggested mapping contains for an unknown time.
/// Such a mapping cannot be imported.
bool IsTimeToFillIn(const ConfigMap& holder);

class RowTimes {
 public:
  /// Only rows for which `counts` is true advance the count of days or counter periods; without
  /// `counts`, all rows do. Throws InputError for a missing column.
  RowTimes(const RowTable& table, const RowTime& time,
           const std::function<bool(std::size_t row)>& counts = nullptr);

  /// Time of a row. It is exact for stamps, calendar texts and plain digits, and otherwise has
  /// double precision. Throws InputError if the row has no time.
  TimeNs At(std::size_t row) const;
  /// TurnOfCounter for a row whose time is before `before_ns`, if the time is a single column.
  std::optional<double> TurnAt(std::size_t row, TimeNs before_ns, TimeNs step_ns) const;
  /// Column that messages name for an unsuitable time.
  std::size_t place() const { return places_.empty() ? 0 : places_.front(); }

 private:
  /// Time of a row before periods of a wrapping counter are added.
  TimeNs WithoutTurns(std::size_t row) const;
  TimeNs OfNumber(std::size_t row) const;
  TimeNs OfDate(std::size_t row) const;
  TimeNs OfGpsWeek(std::size_t row) const;
  TimeNs ClockAt(std::size_t row, std::size_t place, TimeNs ahead_ns) const;
  /// Throws InputError if the field is a calendar text although a number is needed.
  void RefuseTextOfCalendar(std::size_t row, std::size_t place) const;
  std::string_view TextAt(std::size_t row, std::size_t place, const char* need) const;
  /// Time of a wrapping counter within its period; nullopt for a row without a time.
  std::optional<TimeNs> WithinTurn(std::size_t row) const;
  void CountTurns(const std::function<bool(std::size_t row)>& counts);

  const RowTable& table_;
  const RowTime& time_;
  MappedColumn number_;
  std::vector<std::size_t> places_;   ///< indices of the columns that `time_` uses
  TimeNs turn_ns_ = 0;                ///< period of a wrapping counter; 0: no wrap
  std::vector<std::uint32_t> turns_;  ///< number of periods since the first row, per row
};

}  // namespace tera
