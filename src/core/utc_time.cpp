#include "core/utc_time.h"

#include <charconv>
#include <chrono>

namespace tera {
namespace {

/// A 0 stands for any digit. Every other character stands for itself.
constexpr std::string_view kForm = "0000-00-00T00:00:00Z";
constexpr int kFirstYear = 1970, kLastYear = 2037;  // range of ROS time in signed 32-bit seconds

}  // namespace

std::optional<TimeNs> ParseUtc(std::string_view text) {
  if (text.size() != kForm.size()) return std::nullopt;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const bool digit = text[k] >= '0' && text[k] <= '9';
    if (kForm[k] == '0' ? !digit : text[k] != kForm[k]) return std::nullopt;
  }
  const auto number = [&](std::size_t at, std::size_t digits) {
    int value = 0;
    std::from_chars(text.data() + at, text.data() + at + digits, value);
    return value;
  };
  const std::chrono::year_month_day date(std::chrono::year(number(0, 4)),
                                         std::chrono::month(static_cast<unsigned>(number(5, 2))),
                                         std::chrono::day(static_cast<unsigned>(number(8, 2))));
  const int hour = number(11, 2), minute = number(14, 2), second = number(17, 2);
  if (!date.ok() || number(0, 4) < kFirstYear || number(0, 4) > kLastYear || hour > 23 ||
      minute > 59 || second > 59) {
    return std::nullopt;
  }
  const std::chrono::sys_seconds time = std::chrono::sys_days(date) + std::chrono::hours(hour) +
                                        std::chrono::minutes(minute) + std::chrono::seconds(second);
  return time.time_since_epoch().count() * kNsPerSecond;
}

}  // namespace tera
