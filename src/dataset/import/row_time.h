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

/// When the rows of a table were, as `time:` of a mapping says.
struct RowTime {
  enum class Form {
    kNumber,    ///< `number` gives seconds, or is a column of stamps
    kInterval,  ///< the first row was at `number`, a constant; each is `interval_s` after the last
    kDate,      ///< dates in `date`, with the time of day in `clock` where that is not empty
    kClock,     ///< times of day in `clock`; one that goes back by half a day is of the next day
    kGpsWeek,   ///< `number` gives seconds of the week of GPS time in `week`
  };
  Form form = Form::kNumber;
  ColumnMapping number;
  double interval_s = 0;
  std::string date, clock, week;
  std::optional<DateOrder> order;
  double wraps_at = 0;   ///< the number of the column at which it begins anew at 0; 0: it goes on
  TimeNs ahead_ns = 0;   ///< of UTC, of texts without a zone
  TimeNs offset_ns = 0;  ///< of all forms but numbers, which have their own

  /// All columns that it is made of.
  std::vector<std::string> Columns() const;
};

/// The number at which a counter begins anew at 0, where `after` follows `before` by about `step`
/// so: 2^16, 2^24, 2^31 or 2^32 of its units or thousandths or millionths of these, an hour, a day
/// or a week. Nothing where it does not.
std::optional<double> TurnOfCounter(double before, double after, double step);

/// Reads `{column:, unit:, scale:, offset:, wraps_at:}`, `{sum:}`, `{interval:, unit:, offset:}`,
/// `{date:, clock:, order:, zone:, offset:}` or `{week:, column:, unit:, offset:}`. A column of
/// stamps, as bags and logs of known form have them (`has_stamps`), needs no unit.
RowTime ReadRowTime(const ConfigMap& time, bool has_stamps);

/// Whether the key `time` of a mapping says nothing yet, as a suggestion leaves it that does not
/// know it. That is a fault there.
bool IsTimeToFillIn(const ConfigMap& holder);

/// Times of the rows of one table.
class RowTimes {
 public:
  /// Times of day count days, and counters that begin anew their turns, over the rows that `counts`
  /// takes; without it, over all of them.
  /// Throws InputError where a column is missing.
  RowTimes(const RowTable& table, const RowTime& time,
           const std::function<bool(std::size_t row)>& counts = nullptr);

  /// Exactly where the table has stamps, texts of the calendar or numbers of digits alone; of other
  /// numbers as far as doubles hold them. Throws InputError where the row has no time.
  TimeNs At(std::size_t row) const;
  /// TurnOfCounter of a time in one column that does not go on from `before_ns`.
  std::optional<double> TurnAt(std::size_t row, TimeNs before_ns, TimeNs step_ns) const;
  /// The column to name where a time does not fit.
  std::size_t place() const { return places_.empty() ? 0 : places_.front(); }

 private:
  /// As if no time began anew.
  TimeNs WithoutTurns(std::size_t row) const;
  TimeNs OfNumber(std::size_t row) const;
  TimeNs OfDate(std::size_t row) const;
  TimeNs OfGpsWeek(std::size_t row) const;
  TimeNs ClockAt(std::size_t row, std::size_t place, TimeNs ahead_ns) const;
  /// A text of the calendar where a number is asked for is told from other faults.
  void RefuseTextOfCalendar(std::size_t row, std::size_t place) const;
  std::string_view TextAt(std::size_t row, std::size_t place, const char* need) const;
  /// The time within its turn, of times that begin anew; nothing where the row has none.
  std::optional<TimeNs> WithinTurn(std::size_t row) const;
  void CountTurns(const std::function<bool(std::size_t row)>& counts);

  const RowTable& table_;
  const RowTime& time_;
  MappedColumn number_;
  std::vector<std::size_t> places_;   ///< of the columns of `time_`
  TimeNs turn_ns_ = 0;                ///< after which times begin anew; 0: they go on
  std::vector<std::uint32_t> turns_;  ///< since that of the first row
};

}  // namespace tera
