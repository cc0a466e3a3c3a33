#include "dataset/import/calendar_time.h"

#include <gtest/gtest.h>

#include <string>

namespace tera {
namespace {

// `date -u -d 2024-05-01T12:34:56Z +%s` is 1714566896, of 2026-11-28T00:00:00Z 1795824000.
constexpr TimeNs kMay_ns = 1'714'566'896 * kNsPerSecond;
constexpr TimeNs kNovember_ns = 1'795'824'000 * kNsPerSecond;

TimeNs TimeOfText(const std::string& text, std::optional<DateOrder> order = std::nullopt) {
  const auto time = CalendarTimeOf(text, order);
  EXPECT_TRUE(time) << text;
  return time ? time->t_ns : 0;
}

TEST(CalendarTime, IsReadInTheFormsOfIso8601) {
  for (const std::string text :
       {"2024-05-01T12:34:56Z", "2024-05-01 12:34:56", "2024-05-01T14:34:56+02:00",
        "2024-05-01T14:34:56+0200", "2024-05-01T14:34:56+02", "2024-05-01 07:04:56-05:30",
        "20240501T123456Z", "2024/05/01 12:34:56 UTC", "2024-05-01_12:34:56", "2024.05.01 12:34:56",
        "2024-5-1 12:34:56", "01.05.2024 12:34:56", "1.5.2024  12:34:56", "01-May-2024 12:34:56",
        "2024/05/01 12:34:56 PM", "20240501 12:34:56"}) {
    EXPECT_EQ(TimeOfText(text), kMay_ns) << text;
  }
  EXPECT_EQ(TimeOfText("2026-11-28"), kNovember_ns);
  EXPECT_EQ(TimeOfText("2026-11-28 00:00"), kNovember_ns);
  EXPECT_EQ(TimeOfText("28.11.2026 12:00:00 AM"), kNovember_ns);
}

// `date -d TEXT +%s` reads each of them.
TEST(CalendarTime, MonthsAndWeekdaysMayHaveNames) {
  for (const std::string text : {"Sat Nov 28 22:46:10 2026", "Sat Nov 28 22:46:10 UTC 2026",
                                 "Nov 28 2026 22:46:10", "Saturday, November 28, 2026 22:46:10",
                                 "Sat, 28 Nov 2026 22:46:10 GMT", "28 November 2026 22:46:10",
                                 "Sun Nov 29 00:46:10 2026 +0200", "Nov 28, 2026 10:46:10 PM"}) {
    EXPECT_EQ(TimeOfText(text), 1'795'905'970 * kNsPerSecond) << text;
  }
  EXPECT_EQ(TimeOfText("Wed May  1 12:34:56.5 2024"), kMay_ns + 500'000'000);
  EXPECT_FALSE(CalendarTimeOf("Sat Nov 28 22:46:10 2026", {})->has_zone);
  EXPECT_TRUE(CalendarTimeOf("Sat Nov 28 22:46:10 UTC 2026", {})->has_zone);
  EXPECT_FALSE(CalendarTimeOf("Sat Nov 31 22:46:10 2026", {}));
  EXPECT_FALSE(CalendarTimeOf("Sat Nov 28", {}));
}

TEST(CalendarTime, FractionsOfAnyLengthAreExactToTheNanosecond) {
  EXPECT_EQ(TimeOfText("2024-05-01T12:34:56.7Z"), kMay_ns + 700'000'000);
  EXPECT_EQ(TimeOfText("2024-05-01T12:34:56,020"), kMay_ns + 20'000'000);
  EXPECT_EQ(TimeOfText("2024-05-01 12:34:56:020"), kMay_ns + 20'000'000);
  EXPECT_EQ(TimeOfText("2024-05-01T12:34:56.123456789Z"), kMay_ns + 123'456'789);
  EXPECT_EQ(TimeOfText("2024-05-01T12:34:56.1234567899+00:00"), kMay_ns + 123'456'789);
}

TEST(CalendarTime, TellsWhetherThereIsAZoneAndAClock) {
  EXPECT_TRUE(CalendarTimeOf("2024-05-01T12:34:56Z", {})->has_zone);
  EXPECT_FALSE(CalendarTimeOf("2024-05-01T12:34:56", {})->has_zone);
  EXPECT_FALSE(CalendarTimeOf("2024-05-01", {})->has_clock);
}

TEST(CalendarTime, DayAndMonthBeforeTheYearNeedTheirOrder) {
  EXPECT_TRUE(NeedsDateOrder("11/28/2026 00:00:00"));
  EXPECT_FALSE(NeedsDateOrder("28.11.2026 00:00:00"));
  EXPECT_FALSE(CalendarTimeOf("11/28/2026 00:00:00", std::nullopt));
  EXPECT_EQ(TimeOfText("11/28/2026 00:00:00", DateOrder::kMonthFirst), kNovember_ns);
  EXPECT_EQ(TimeOfText("28/11/2026 00:00:00", DateOrder::kDayFirst), kNovember_ns);
  EXPECT_EQ(TimeOfText("28-11-26 00:00:00", DateOrder::kDayFirst), kNovember_ns);
  EXPECT_FALSE(CalendarTimeOf("28/11/2026 00:00:00", DateOrder::kMonthFirst));
}

TEST(CalendarTime, WhatIsNoneIsNone) {
  for (const std::string text :
       {"", "12", "20.5", "2024-05-01T", "2024-13-01", "2024-02-30 00:00:00", "2024-05-01T25:00:00",
        "2024-05-01T12:60:00", "2024-05-01T12:34:56 boom", "2024-05-01T12:34:56+", "1.5", "1-2",
        "boom", "2024-05-01X12:34:56", "2024-05-01T24:00:01", "2024-05-01T24:30",
        "01.05.024 12:00:00", "01.05.20245 12:00:00"}) {
    EXPECT_FALSE(CalendarTimeOf(text, DateOrder::kDayFirst)) << text;
  }
}

TEST(ClockTime, IsATimeOfDay) {
  EXPECT_EQ(ClockTimeOf("12:34:56.5")->t_ns, 45'296'500'000'000);
  EXPECT_EQ(ClockTimeOf("9:04:05")->t_ns, 32'645 * kNsPerSecond);
  EXPECT_EQ(ClockTimeOf("12:34")->t_ns, 45'240 * kNsPerSecond);
  EXPECT_EQ(ClockTimeOf("01:00:00 PM")->t_ns, 46'800 * kNsPerSecond);
  // Minutes and seconds are not hours and minutes.
  EXPECT_FALSE(ClockTimeOf("05:23.4"));
  EXPECT_EQ(ClockTimeOf("123456.50")->t_ns, 45'296'500'000'000);
  EXPECT_FALSE(ClockTimeOf("123"));
  EXPECT_FALSE(ClockTimeOf("12"));
  EXPECT_EQ(ClockTimeOf("24:00")->t_ns, 86'400 * kNsPerSecond);
  EXPECT_FALSE(ClockTimeOf("24:00:00.001"));
}

}  // namespace
}  // namespace tera
