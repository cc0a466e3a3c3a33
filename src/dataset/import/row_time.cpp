#include "dataset/import/row_time.h"

#include <fmt/format.h>

#include <cmath>

#include "core/error.h"
#include "dataset/format/epoch.h"
#include "dataset/import/logs/log_time.h"
#include "dataset/import/table_text.h"

namespace tera {
namespace {

constexpr TimeNs kDayNs = 86'400 * kNsPerSecond, kWeekNs = 7 * kDayNs;
constexpr double kFarthest_s = 9e9;  // beyond, nanoseconds do not fit into 64 bits

constexpr const char* kNeedDate =
    "need a date and a time of day as of ISO 8601, 2026-11-28T12:34:56.789Z; where day or month "
    "stand first say order: dmy or mdy";
constexpr const char* kNeedClock = "need a time of day, 12:34:56.789";

std::optional<DateOrder> ReadDateOrder(const ConfigMap& time) {
  const std::string order = time.Choice("order", {"auto", "ymd", "dmy", "mdy"}, "auto");
  if (order == "auto") return std::nullopt;
  return order == "ymd"   ? DateOrder::kYearFirst
         : order == "dmy" ? DateOrder::kDayFirst
                          : DateOrder::kMonthFirst;
}

/// By how much the clock of texts without a zone is ahead of UTC.
TimeNs ReadZone(const ConfigMap& time) {
  const std::string zone = time.Text("zone", "Z");
  const auto midnight = ClockTimeOf("00:00:00 " + zone);
  if (!midnight || !midnight->has_zone) {
    time.Fault("zone", fmt::format("'{}' is no zone; need Z or an offset as \"+01:00\"", zone));
  }
  return midnight ? -midnight->t_ns : 0;
}

RowTime ReadCalendarTime(const ConfigMap& time) {
  RowTime read;
  read.form = time.Has("date") ? RowTime::Form::kDate : RowTime::Form::kClock;
  read.date = time.Text("date", "");
  read.clock = time.Text("clock", "");
  read.order = ReadDateOrder(time);
  read.ahead_ns = ReadZone(time);
  read.offset_ns = FromSeconds(time.Number("offset", Any("s"), 0.0));
  return read;
}

}  // namespace

std::vector<std::string> RowTime::Columns() const {
  std::vector<std::string> columns;
  for (const ColumnTerm& term : number.Terms()) columns.push_back(term.column);
  for (const std::string& column : {date, clock, week}) {
    if (!column.empty()) columns.push_back(column);
  }
  return columns;
}

RowTime ReadRowTime(const ConfigMap& time, bool has_stamps) {
  if (time.Has("date") || time.Has("clock")) return ReadCalendarTime(time);
  RowTime read;
  if (const auto interval = time.OptionalNumber("interval", Positive(""))) {
    read.form = RowTime::Form::kInterval;
    read.interval_s = *interval * ReadUnitFactor(time, Dimension::kTime);
    read.number.offset = time.Number("offset", Any("s"), 0.0);
    return read;
  }
  if (has_stamps && !time.Has("unit")) {
    read.number = {.column = time.Text("column"), .offset = time.Number("offset", Any("s"), 0.0)};
    return read;
  }
  const Range allowed = Between(-kFarthest_s, kFarthest_s, "s");
  if (time.Has("week")) {
    read.form = RowTime::Form::kGpsWeek;
    read.week = time.Text("week");
  }
  read.number = ReadColumnMapping(time, Dimension::kTime, allowed);
  return read;
}

bool IsTimeToFillIn(const ConfigMap& holder) {
  if (!holder.IsText("time")) return false;
  holder.Fault("time",
               {FaultKind::kMissing,
                fmt::format("'{}' says nothing of the time; need {{column: NAME, unit: s}} (or ms, "
                            "us, ns), {{date: NAME}} for dates, or {{interval: 20, unit: ms}} "
                            "where rows have no time",
                            holder.Text("time"))});
  return true;
}

RowTimes::RowTimes(const RowTable& table, const RowTime& time,
                   const std::function<bool(std::size_t row)>& counts)
    : table_(table), time_(time), number_(table, time.number) {
  for (const std::string& column : time.Columns()) places_.push_back(table.Column(column));
  if (time.form == RowTime::Form::kClock) CountDays(counts);
}

TimeNs RowTimes::At(std::size_t row) const {
  switch (time_.form) {
    case RowTime::Form::kInterval:
      return FromSeconds(time_.number.offset +
                         static_cast<double>(table_.Ordinal(row)) * time_.interval_s);
    case RowTime::Form::kDate:
      return OfDate(row) + time_.offset_ns;
    case RowTime::Form::kClock:
      return ClockAt(row, places_.front()) + days_[row] * kDayNs + time_.offset_ns;
    case RowTime::Form::kGpsWeek:
      return OfGpsWeek(row);
    case RowTime::Form::kNumber:
      break;
  }
  return OfNumber(row);
}

TimeNs RowTimes::OfNumber(std::size_t row) const {
  if (time_.number.column.empty()) return FromSeconds(time_.number.offset);
  const TimeNs offset_ns = FromSeconds(time_.number.offset);
  const std::vector<ColumnTerm>& terms = number_.terms();
  if (const auto stamp_ns = table_.Stamp(row, places_.front())) {
    if (terms.front().factor != 1.0) {
      table_.Fail(row, places_.front(), "which is a time already; leave out its unit and scale");
    }
    return *stamp_ns + offset_ns;
  }
  TimeNs sum_ns = 0;
  for (std::size_t k = 0; k < terms.size(); ++k) {
    const auto exact_ns = terms[k].factor_ns > 0
                              ? table_.WholeNanoseconds(row, places_[k], terms[k].factor_ns)
                              : std::nullopt;
    if (!exact_ns) {
      RefuseTextOfCalendar(row, places_[k]);
      return FromSeconds(number_.At(row));
    }
    if (__builtin_add_overflow(sum_ns, *exact_ns, &sum_ns)) return FromSeconds(number_.At(row));
  }
  return sum_ns + offset_ns;
}

void RowTimes::RefuseTextOfCalendar(std::size_t row, std::size_t place) const {
  const std::string_view text = table_.Text(row, place).value_or("");
  if (!CalendarTimeOf(text, DateOrder::kDayFirst) && !NeedsDateOrder(text) && !ClockTimeOf(text)) {
    return;
  }
  table_.Fail(row, place,
              "which is of the calendar; say time: {date: NAME} of a date with a time of day, "
              "{date: NAME, clock: NAME} of two columns, {clock: NAME} of a time of day alone");
}

std::string_view RowTimes::TextAt(std::size_t row, std::size_t place, const char* need) const {
  const auto text = table_.Text(row, place);
  if (!text || SaysNothing(*text)) {
    table_.Fail(row, place, fmt::format("{}, or leave such rows out by --skip-bad-rows", need));
  }
  return *text;
}

TimeNs RowTimes::OfDate(std::size_t row) const {
  const std::size_t place = places_.front();
  const auto date = CalendarTimeOf(TextAt(row, place, kNeedDate), time_.order);
  if (!date) table_.Fail(row, place, kNeedDate);
  if (!time_.clock.empty()) {
    // The first of two columns may have a midnight of its own.
    return date->t_ns / kDayNs * kDayNs + ClockAt(row, places_[1]);
  }
  if (!date->has_clock) {
    table_.Fail(row, place,
                "which has no time of day; name the column that has it: time: {date: NAME, clock: "
                "NAME}");
  }
  return date->t_ns - (date->has_zone ? 0 : time_.ahead_ns);
}

TimeNs RowTimes::ClockAt(std::size_t row, std::size_t place) const {
  const auto clock = ClockTimeOf(TextAt(row, place, kNeedClock));
  if (!clock) table_.Fail(row, place, kNeedClock);
  return clock->t_ns - (clock->has_zone ? 0 : time_.ahead_ns);
}

TimeNs RowTimes::OfGpsWeek(std::size_t row) const {
  constexpr double kLeastWeek = 1024, kMostWeek = 8192;
  const std::size_t place = places_.back();
  const double week = table_.Number(row, place);
  if (week < kLeastWeek || week > kMostWeek || week != std::round(week)) {
    table_.Fail(row, place,
                "need a week since 1980-01-06, 1024 to 8192; a receiver that counts to 1023 alone "
                "leaves out 1024 or 2048 of them");
  }
  const TimeNs of_week_ns = OfNumber(row);
  if (of_week_ns < 0 || of_week_ns > kWeekNs) {
    table_.Fail(row, places_.front(), "need a time of the week, 0 to 604800 s");
  }
  const TimeNs gps_ns = GpsWeek(static_cast<int>(week)) + of_week_ns;
  return gps_ns - GpsAheadOfUtc(gps_ns);
}

void RowTimes::CountDays(const std::function<bool(std::size_t row)>& counts) {
  days_.resize(table_.row_count());
  TimeNs before_ns = 0;
  std::uint16_t day = 0;
  for (std::size_t row = 0; row < table_.row_count(); ++row) {
    const auto clock = ClockTimeOf(table_.Text(row, places_.front()).value_or(""));
    if (clock && (!counts || counts(row))) {
      if (before_ns - clock->t_ns > kDayNs / 2) ++day;
      before_ns = clock->t_ns;
    }
    days_[row] = day;
  }
}

}  // namespace tera
