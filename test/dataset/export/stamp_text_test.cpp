#include "dataset/export/stamp_text.h"

#include <gtest/gtest.h>

namespace tera {
namespace {

TEST(StampText, SecondsAreExactOnBothSidesOfZero) {
  EXPECT_EQ(SecondsText(0), "0.000000000");
  EXPECT_EQ(SecondsText(1), "0.000000001");
  EXPECT_EQ(SecondsText(-250'000'000), "-0.250000000");
  EXPECT_EQ(SecondsText(-1'000'000'001), "-1.000000001");
  // Beyond the 53 bits of a double.
  EXPECT_EQ(SecondsText(1'714'564'800'123'456'789), "1714564800.123456789");
}

TEST(StampText, FewerDigitsAreRoundedNotCut) {
  EXPECT_EQ(SecondsText(1'999'600'000, 3), "2.000");
  EXPECT_EQ(SecondsText(1'999'400'000, 3), "1.999");
  EXPECT_EQ(SecondsText(-1'999'600'000, 3), "-2.000");
  EXPECT_EQ(SecondsText(2'500'000'000, 0), "3");
}

TEST(StampText, CivilTimeIsThatOfTheCalendar) {
  // date -u -d @1709251199: the last second of a 29th of February.
  const CivilTime leap = CivilTimeOf(1'709'251'199 * kNsPerSecond + 999'999'999);
  EXPECT_EQ(leap.year, 2024);
  EXPECT_EQ(leap.month, 2);
  EXPECT_EQ(leap.day, 29);
  EXPECT_EQ(leap.hour, 23);
  EXPECT_EQ(leap.minute, 59);
  EXPECT_EQ(leap.second, 59);
  EXPECT_EQ(leap.nanosecond, 999'999'999);
  // Before 1970: a clock that is behind.
  const CivilTime before = CivilTimeOf(-1);
  EXPECT_EQ(before.year, 1969);
  EXPECT_EQ(before.second, 59);
  EXPECT_EQ(before.nanosecond, 999'999'999);
}

}  // namespace
}  // namespace tera
