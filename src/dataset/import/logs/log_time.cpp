#include "dataset/import/logs/log_time.h"

#include <chrono>

#include "core/parse_number.h"

namespace tera {
namespace {

/// Parses a number that consists of digits only.
std::optional<int> Digits(std::string_view text) {
  for (const char c : text) {
    if (c < '0' || c > '9') return std::nullopt;
  }
  return ParseNumber<int>(text);
}

}  // namespace

std::optional<TimeNs> DayOf(int year, int month, int day) {
  constexpr int kFirstYear = 1970, kLastYear = 2200;  // range of 64-bit nanoseconds
  const std::chrono::year_month_day date(std::chrono::year(year),
                                         std::chrono::month(static_cast<unsigned>(month)),
                                         std::chrono::day(static_cast<unsigned>(day)));
  if (year < kFirstYear || year > kLastYear || !date.ok()) return std::nullopt;
  const std::chrono::sys_seconds midnight{std::chrono::sys_days(date)};
  return midnight.time_since_epoch().count() * kNsPerSecond;
}

std::optional<TimeNs> DateOfText(std::string_view text) {
  if (text.size() != 10 || text[4] != text[7] || (text[4] != '/' && text[4] != '-')) {
    return std::nullopt;
  }
  const auto year = Digits(text.substr(0, 4)), month = Digits(text.substr(5, 2)),
             day = Digits(text.substr(8, 2));
  if (!year || !month || !day) return std::nullopt;
  return DayOf(*year, *month, *day);
}

std::optional<TimeNs> SecondsOfText(std::string_view text) {
  const std::size_t point = text.find('.');
  const auto whole = Digits(text.substr(0, point));
  if (!whole || text.empty() || point == 0) return std::nullopt;
  TimeNs t_ns = *whole * kNsPerSecond;
  if (point == std::string_view::npos) return t_ns;
  TimeNs digit_ns = kNsPerSecond;
  for (const char c : text.substr(point + 1)) {
    if (c < '0' || c > '9') return std::nullopt;
    digit_ns /= 10;  // truncates below a nanosecond
    t_ns += (c - '0') * digit_ns;
  }
  return t_ns;
}

std::optional<TimeNs> TimeOfDayText(std::string_view text) {
  if (text.size() < 8 || text[2] != ':' || text[5] != ':') return std::nullopt;
  const auto hour = Digits(text.substr(0, 2)), minute = Digits(text.substr(3, 2));
  const auto second_ns = SecondsOfText(text.substr(6));
  if (!hour || !minute || !second_ns || *hour > 23 || *minute > 59 ||
      *second_ns >= 61 * kNsPerSecond) {
    return std::nullopt;
  }
  constexpr TimeNs kMinute_s = 60;
  return (*hour * kMinute_s + *minute) * kMinute_s * kNsPerSecond + *second_ns;
}

TimeNs GpsWeek(int week) {
  constexpr TimeNs kWeek_s = 604'800;
  return *DayOf(1980, 1, 6) + week * kWeek_s * kNsPerSecond;
}

}  // namespace tera
