#include "dataset/import/calendar_time.h"

#include <array>
#include <cctype>
#include <utility>

#include "dataset/import/logs/log_time.h"

namespace tera {
namespace {

constexpr TimeNs kMinute_ns = 60 * kNsPerSecond, kHour_ns = 60 * kMinute_ns;

/// Reads a text part by part.
class TextCursor {
 public:
  explicit TextCursor(std::string_view text) : rest_(text) {}

  bool at_end() const { return rest_.empty(); }
  char next() const { return rest_.empty() ? '\0' : rest_.front(); }
  std::size_t DigitCount() const {
    std::size_t count = 0;
    while (count < rest_.size() && IsDigit(rest_[count])) ++count;
    return count;
  }
  bool TakeOneOf(std::string_view characters) {
    if (rest_.empty() || characters.find(rest_.front()) == std::string_view::npos) return false;
    rest_.remove_prefix(1);
    return true;
  }
  /// Takes a word; case does not matter.
  bool TakeWord(std::string_view lower) {
    if (rest_.size() < lower.size()) return false;
    for (std::size_t k = 0; k < lower.size(); ++k) {
      if (std::tolower(static_cast<unsigned char>(rest_[k])) != lower[k]) return false;
    }
    rest_.remove_prefix(lower.size());
    return true;
  }
  /// Takes a number with `least` to `most` digits.
  std::optional<int> TakeNumber(std::size_t least, std::size_t most) {
    const std::size_t count = DigitCount();
    if (count < least || count > most) return std::nullopt;
    return TakeDigits(count);
  }
  std::optional<int> TakeDigits(std::size_t count) {
    if (DigitCount() < count) return std::nullopt;
    int value = 0;
    for (std::size_t k = 0; k < count; ++k) value = 10 * value + (rest_[k] - '0');
    rest_.remove_prefix(count);
    return value;
  }
  /// Takes all following digits as a fraction of a second.
  TimeNs TakeFraction_ns() {
    TimeNs fraction_ns = 0, digit_ns = kNsPerSecond;
    for (std::size_t count = DigitCount(); count > 0; --count) {
      digit_ns /= 10;  // truncates below a nanosecond
      fraction_ns += (rest_.front() - '0') * digit_ns;
      rest_.remove_prefix(1);
    }
    return fraction_ns;
  }
  void SkipBlanks() {
    while (TakeOneOf(" ")) {
    }
  }
  void SkipLetters() {
    while (!rest_.empty() && std::isalpha(static_cast<unsigned char>(rest_.front())) != 0) {
      rest_.remove_prefix(1);
    }
  }

 private:
  static bool IsDigit(char c) { return c >= '0' && c <= '9'; }
  std::string_view rest_;
};

std::optional<int> TakeMonthName(TextCursor* text) {
  constexpr std::array<std::string_view, 12> kMonths = {"jan", "feb", "mar", "apr", "may", "jun",
                                                        "jul", "aug", "sep", "oct", "nov", "dec"};
  for (std::size_t m = 0; m < kMonths.size(); ++m) {
    if (!text->TakeWord(kMonths[m])) continue;
    text->SkipLetters();
    return static_cast<int>(m) + 1;
  }
  return std::nullopt;
}

/// Skips "Sat " or "Sat, ".
void SkipWeekday(TextCursor* text) {
  for (const char* day : {"mon", "tue", "wed", "thu", "fri", "sat", "sun"}) {
    TextCursor after = *text;
    if (!after.TakeWord(day)) continue;
    after.SkipLetters();
    after.TakeOneOf(",");
    if (!after.TakeOneOf(" ")) continue;
    after.SkipBlanks();
    *text = after;
    return;
  }
}

struct TakenDate {
  TimeNs day_ns = 0;
  bool is_compact = false;   ///< such as 20261128
  bool needs_order = false;  ///< ambiguous: the year is last, and day and month could be swapped
};

std::optional<TakenDate> TakeYearFirst(TextCursor* text) {
  const bool is_compact = text->DigitCount() == 8;
  const auto year = text->TakeDigits(4);
  const char separator = text->next();
  if (!is_compact && !text->TakeOneOf("-/._")) return std::nullopt;
  const auto month = is_compact ? text->TakeDigits(2) : text->TakeNumber(1, 2);
  if (!is_compact && !text->TakeOneOf(std::string_view(&separator, 1))) return std::nullopt;
  const auto day = is_compact ? text->TakeDigits(2) : text->TakeNumber(1, 2);
  if (!year || !month || !day) return std::nullopt;
  const auto day_ns = DayOf(*year, *month, *day);
  return day_ns ? std::optional(TakenDate{*day_ns, is_compact, false}) : std::nullopt;
}

std::optional<TakenDate> TakeYearLast(TextCursor* text, std::optional<DateOrder> order) {
  const auto first = text->TakeNumber(1, 2);
  const char separator = text->next();
  if (!first || !text->TakeOneOf("-/. ")) return std::nullopt;
  const auto named = TakeMonthName(text);
  const auto second = named ? named : text->TakeNumber(1, 2);
  if (!second || !text->TakeOneOf(std::string_view(&separator, 1))) return std::nullopt;
  const bool has_century = text->DigitCount() == 4;
  const bool day_is_first = named || separator == '.' || order == DateOrder::kDayFirst;
  auto year = text->TakeDigits(has_century ? 4 : 2);
  if (!year || (!has_century && !named && separator != '.' && !order)) return std::nullopt;
  if (!has_century && text->DigitCount() > 0) return std::nullopt;
  if (!has_century) *year += 2000;
  const bool is_told = day_is_first || order == DateOrder::kMonthFirst;
  const bool swapped = order == DateOrder::kMonthFirst && !named;
  const auto day_ns = DayOf(*year, swapped ? *first : *second, swapped ? *second : *first);
  if (!is_told) return TakenDate{0, false, true};
  return day_ns ? std::optional(TakenDate{*day_ns, false, false}) : std::nullopt;
}

std::optional<TakenDate> TakeDate(TextCursor* text, std::optional<DateOrder> order) {
  if (text->DigitCount() != 4 && text->DigitCount() != 8) return TakeYearLast(text, order);
  return TakeYearFirst(text);
}

/// Takes hours, minutes and optional seconds with an optional fraction.
std::optional<TimeNs> TakeClock(TextCursor* text, bool is_compact) {
  const auto hour = is_compact ? text->TakeDigits(2) : text->TakeNumber(1, 2);
  const bool has_minutes = is_compact || text->TakeOneOf(":");
  const auto minute = has_minutes ? text->TakeDigits(2) : std::nullopt;
  if (!hour || !minute || *hour > 24 || *minute > 59) return std::nullopt;
  TimeNs second_ns = 0;
  if (is_compact ? text->DigitCount() >= 2 : text->TakeOneOf(":")) {
    const auto second = text->TakeDigits(2);
    if (!second || *second > 60) return std::nullopt;
    second_ns = *second * kNsPerSecond;
    if (text->TakeOneOf(".,:")) second_ns += text->TakeFraction_ns();
  }
  if (*hour == 24 && (*minute > 0 || second_ns > 0)) return std::nullopt;
  TimeNs hours = *hour;
  text->SkipBlanks();
  const bool is_am = text->TakeWord("am"), is_pm = !is_am && text->TakeWord("pm");
  constexpr TimeNs kNoon = 12;
  if (is_am || is_pm) {
    if (hours < 1 || hours > kNoon) return std::nullopt;
    hours = hours % kNoon + (is_pm ? kNoon : 0);
  }
  return hours * kHour_ns + *minute * kMinute_ns + second_ns;
}

struct TakenZone {
  bool is_there = false;
  TimeNs ahead_ns = 0;
};

/// Takes a time zone; nullopt if it is invalid.
std::optional<TakenZone> TakeZone(TextCursor* text) {
  text->SkipBlanks();
  if (text->at_end()) return TakenZone{};
  const bool named = text->TakeWord("utc") || text->TakeWord("gmt") || text->TakeWord("z");
  if (named && text->at_end()) return TakenZone{true, 0};
  const bool is_behind = text->next() == '-';
  if (!text->TakeOneOf("+-")) return std::nullopt;
  const auto hours = text->DigitCount() == 1 ? text->TakeDigits(1) : text->TakeDigits(2);
  text->TakeOneOf(":");
  const auto minutes = text->at_end() ? std::optional(0) : text->TakeDigits(2);
  if (!hours || !minutes || !text->at_end()) return std::nullopt;
  const TimeNs ahead_ns = *hours * kHour_ns + *minutes * kMinute_ns;
  return TakenZone{true, is_behind ? -ahead_ns : ahead_ns};
}

CalendarTime OfParts(TimeNs day_ns, TimeNs clock_ns, const TakenZone& zone) {
  return {day_ns + clock_ns - zone.ahead_ns, zone.is_there, zone.ahead_ns, true};
}

/// Takes "Nov 28 22:46:10 2026" or "Nov 28, 2026 22:46:10".
std::optional<CalendarTime> TakeMonthFirst(TextCursor text) {
  const auto month = TakeMonthName(&text);
  if (!month || !text.TakeOneOf(" ")) return std::nullopt;
  text.SkipBlanks();
  const auto day = text.TakeNumber(1, 2);
  text.TakeOneOf(",");
  if (!day || !text.TakeOneOf(" ")) return std::nullopt;
  text.SkipBlanks();
  const bool year_is_last = text.DigitCount() != 4;
  std::optional<int> year = year_is_last ? std::nullopt : text.TakeDigits(4);
  text.SkipBlanks();
  if (!year_is_last && text.at_end()) {
    const auto day_ns = DayOf(year.value_or(0), *month, *day);
    return day_ns ? std::optional(CalendarTime{*day_ns, false, 0, false}) : std::nullopt;
  }
  const auto clock_ns = TakeClock(&text, false);
  text.SkipBlanks();
  const bool is_utc = year_is_last && (text.TakeWord("utc ") || text.TakeWord("gmt "));
  if (year_is_last) year = text.TakeDigits(4);
  auto zone = TakeZone(&text);
  const auto day_ns = DayOf(year.value_or(0), *month, *day);
  if (!clock_ns || !zone || !day_ns) return std::nullopt;
  zone->is_there = zone->is_there || is_utc;
  return OfParts(*day_ns, *clock_ns, *zone);
}

}  // namespace

std::optional<CalendarTime> CalendarTimeOf(std::string_view text, std::optional<DateOrder> order) {
  TextCursor cursor(text);
  SkipWeekday(&cursor);
  if (const auto time = TakeMonthFirst(cursor)) return time;
  const auto date = TakeDate(&cursor, order);
  if (!date || date->needs_order) return std::nullopt;
  if (cursor.at_end()) return CalendarTime{date->day_ns, false, 0, false};
  if (!cursor.TakeOneOf("Tt _")) return std::nullopt;
  cursor.SkipBlanks();
  const auto clock_ns = TakeClock(&cursor, date->is_compact && cursor.DigitCount() >= 4);
  const auto zone = clock_ns ? TakeZone(&cursor) : std::nullopt;
  if (!zone) return std::nullopt;
  return OfParts(date->day_ns, *clock_ns, *zone);
}

std::optional<CalendarTime> ClockTimeOf(std::string_view text) {
  TextCursor cursor(text);
  constexpr std::size_t kCompactDigits = 6;
  const auto clock_ns = TakeClock(&cursor, cursor.DigitCount() == kCompactDigits);
  const auto zone = clock_ns ? TakeZone(&cursor) : std::nullopt;
  if (!zone) return std::nullopt;
  return OfParts(0, *clock_ns, *zone);
}

bool NeedsDateOrder(std::string_view text) {
  TextCursor cursor(text);
  SkipWeekday(&cursor);
  const auto date = TakeDate(&cursor, std::nullopt);
  return date && date->needs_order;
}

}  // namespace tera
