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
constexpr double kFarthest_s = 9e9;  // range of 64-bit nanoseconds

constexpr const char* kNeedDate =
    "need a date and a time of day of ISO 8601, 2026-11-28T12:34:56.789Z; if day or month come "
    "first, set order: dmy or mdy";
constexpr const char* kNeedClock = "need a time of day, 12:34:56.789";

std::optional<DateOrder> ReadDateOrder(const ConfigMap& time) {
  const std::string order = time.Choice("order", {"auto", "ymd", "dmy", "mdy"}, "auto");
  if (order == "auto") return std::nullopt;
  return order == "ymd"   ? DateOrder::kYearFirst
         : order == "dmy" ? DateOrder::kDayFirst
                          : DateOrder::kMonthFirst;
}

/// Local time minus UTC for texts without a time zone.
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
  if (const auto wraps_at = time.OptionalNumber("wraps_at", Positive(""))) {
    read.wraps_at = *wraps_at;
    if (read.number.column.empty() || !read.number.further.empty() || !read.week.empty()) {
      time.Fault("wraps_at", "applies to a time in one column only; remove it");
    } else if (*wraps_at * std::abs(read.number.factor) > kFarthest_s) {
      time.Fault("wraps_at", {FaultKind::kOutOfRange,
                              fmt::format("{} is too large for a time, need at most {:.3g}",
                                          *wraps_at, kFarthest_s / std::abs(read.number.factor))});
    }
  }
  return read;
}

std::optional<double> TurnOfCounter(double before, double after, double step) {
  constexpr double kMostSteps = 2.5, kLeastSteps = 100;
  constexpr double k16 = 65536, k24 = 16777216, k31 = 2147483648, k32 = 4294967296;
  for (const double turn :
       {k16 / 1e6, k16 / 1e3, k16, k24, k31 / 1e6, k31 / 1e3, k31, k32 / 1e6, k32 / 1e3, k32, 60.0,
        3600.0, 3600e3, 3600e6, 86400.0, 86400e3, 86400e6, 604800.0, 604800e3}) {
    const double across = turn - before + after;
    if (step > 0 && turn > kLeastSteps * step && after >= 0 && before < turn && across > 0 &&
        across < kMostSteps * step) {
      return turn;
    }
  }
  return std::nullopt;
}

bool IsTimeToFillIn(const ConfigMap& holder) {
  if (!holder.IsText("time")) return false;
  holder.Fault(
      "time",
      {FaultKind::kMissing,
       fmt::format("'{}' does not describe a time; need {{column: NAME, unit: s}} (or ms, us, ns), "
                   "{{date: NAME}} for dates, or {{interval: 20, unit: ms}} if rows have no time",
                   holder.Text("time"))});
  return true;
}

RowTimes::RowTimes(const RowTable& table, const RowTime& time,
                   const std::function<bool(std::size_t row)>& counts)
    : table_(table), time_(time), number_(table, time.number) {
  for (const std::string& column : time.Columns()) places_.push_back(table.Column(column));
  if (time.form == RowTime::Form::kClock) turn_ns_ = kDayNs;
  if (time.wraps_at > 0) {
    const TimeNs unit_ns = number_.terms().front().factor_ns;
    const bool is_whole = unit_ns > 0 && time.wraps_at == std::round(time.wraps_at);
    turn_ns_ = is_whole ? unit_ns * static_cast<TimeNs>(time.wraps_at)
                        : FromSeconds(time.wraps_at * number_.terms().front().factor);
  }
  if (turn_ns_ != 0) CountTurns(counts);
}

TimeNs RowTimes::At(std::size_t row) const {
  TimeNs t_ns = WithoutTurns(row), turns_ns = 0;
  if (turns_.empty() || turns_[row] == 0) return t_ns;
  if (__builtin_mul_overflow(turn_ns_, static_cast<TimeNs>(turns_[row]), &turns_ns) ||
      __builtin_add_overflow(t_ns, turns_ns, &t_ns)) {
    table_.Fail(row, place(), {FaultKind::kOutOfRange, "which wraps too often"});
  }
  return t_ns;
}

TimeNs RowTimes::WithoutTurns(std::size_t row) const {
  switch (time_.form) {
    case RowTime::Form::kInterval:
      return FromSeconds(time_.number.offset +
                         static_cast<double>(table_.Ordinal(row)) * time_.interval_s);
    case RowTime::Form::kDate:
      return OfDate(row) + time_.offset_ns;
    case RowTime::Form::kClock:
      return ClockAt(row, places_.front(), time_.ahead_ns) + time_.offset_ns;
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
      table_.Fail(row, places_.front(),
                  {FaultKind::kInconsistent, "which is already a time; remove its unit and scale"});
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
              {FaultKind::kMistyped,
               "which is a calendar time; set time: {date: NAME} for a date with a time of day, "
               "{date: NAME, clock: NAME} for two columns, {clock: NAME} for a time of day alone"});
}

std::string_view RowTimes::TextAt(std::size_t row, std::size_t place, const char* need) const {
  const auto text = table_.Text(row, place);
  if (!text || SaysNothing(*text)) {
    table_.Fail(
        row, place,
        {FaultKind::kMissing, fmt::format("{}, or skip such rows with --skip-bad-rows", need)});
  }
  return *text;
}

TimeNs RowTimes::OfDate(std::size_t row) const {
  const std::size_t place = places_.front();
  const auto date = CalendarTimeOf(TextAt(row, place, kNeedDate), time_.order);
  if (!date) table_.Fail(row, place, {FaultKind::kMistyped, kNeedDate});
  if (!time_.clock.empty()) {
    // The date column may contain a time of day at midnight, and a time zone that holds for both
    // columns.
    const TimeNs local_ns = date->t_ns + date->ahead_ns;
    return local_ns / kDayNs * kDayNs +
           ClockAt(row, places_[1], date->has_zone ? date->ahead_ns : time_.ahead_ns);
  }
  if (!date->has_clock) {
    table_.Fail(row, place,
                {FaultKind::kMissing,
                 "which has no time of day; name its column: time: {date: NAME, clock: NAME}"});
  }
  return date->t_ns - (date->has_zone ? 0 : time_.ahead_ns);
}

TimeNs RowTimes::ClockAt(std::size_t row, std::size_t place, TimeNs ahead_ns) const {
  const auto clock = ClockTimeOf(TextAt(row, place, kNeedClock));
  if (!clock) table_.Fail(row, place, {FaultKind::kMistyped, kNeedClock});
  return clock->t_ns - (clock->has_zone ? 0 : ahead_ns);
}

TimeNs RowTimes::OfGpsWeek(std::size_t row) const {
  constexpr double kLeastWeek = 1024, kMostWeek = 8192;
  const std::size_t place = places_.back();
  const double week = table_.Number(row, place);
  if (week < kLeastWeek || week > kMostWeek || week != std::round(week)) {
    table_.Fail(row, place,
                {FaultKind::kOutOfRange,
                 "need a week since 1980-01-06, 1024 to 8192; a receiver that counts only to 1023 "
                 "omits 1024 or 2048 weeks"});
  }
  const TimeNs of_week_ns = OfNumber(row);
  if (of_week_ns < 0 || of_week_ns > kWeekNs) {
    table_.Fail(row, places_.front(),
                {FaultKind::kOutOfRange, "need a time of the week, 0 to 604800 s"});
  }
  const TimeNs gps_ns = GpsWeek(static_cast<int>(week)) + of_week_ns;
  return gps_ns - GpsAheadOfUtc(gps_ns);
}

std::optional<TimeNs> RowTimes::WithinTurn(std::size_t row) const {
  if (time_.form == RowTime::Form::kClock) {
    const auto clock = ClockTimeOf(table_.Text(row, places_.front()).value_or(""));
    return clock ? std::optional(clock->t_ns) : std::nullopt;
  }
  const auto number = table_.NumberIfAny(row, places_.front());
  if (!number || *number < 0 || *number > time_.wraps_at) return std::nullopt;
  return FromSeconds(*number * std::abs(number_.terms().front().factor));
}

void RowTimes::CountTurns(const std::function<bool(std::size_t row)>& counts) {
  turns_.resize(table_.row_count());
  TimeNs before_ns = 0;
  std::uint32_t turn = 0;
  for (std::size_t row = 0; row < table_.row_count(); ++row) {
    const auto t_ns = WithinTurn(row);
    if (t_ns && (!counts || counts(row))) {
      if (before_ns - *t_ns > turn_ns_ / 2) ++turn;
      before_ns = *t_ns;
    }
    turns_[row] = turn;
  }
}

std::optional<double> RowTimes::TurnAt(std::size_t row, TimeNs before_ns, TimeNs step_ns) const {
  const auto& terms = number_.terms();
  const bool is_number = time_.form == RowTime::Form::kNumber && terms.size() == 1;
  const auto after = is_number ? table_.NumberIfAny(row, places_.front()) : std::nullopt;
  if (!after || time_.wraps_at > 0 || table_.Stamp(row, places_.front())) return std::nullopt;
  const double unit_s = std::abs(terms.front().factor);
  const double back = ToSeconds(before_ns - At(row)) / unit_s;
  return TurnOfCounter(*after + back, *after, ToSeconds(step_ns) / unit_s);
}

}  // namespace tera
