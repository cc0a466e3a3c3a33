#include "core/utc_time.h"

#include <gtest/gtest.h>

namespace tera {
namespace {

TEST(ParseUtc, CountsFrom1970) {
  EXPECT_EQ(ParseUtc("1970-01-01T00:00:00Z"), 0);
  EXPECT_EQ(ParseUtc("2001-09-09T01:46:40Z"), 1'000'000'000 * kNsPerSecond);
  EXPECT_EQ(ParseUtc("2024-02-29T23:59:59Z"), 1'709'251'199 * kNsPerSecond);
}

TEST(ParseUtc, TakesNothingElse) {
  for (const char* text : {"", "2024-02-30T00:00:00Z", "2023-02-29T00:00:00Z",
                           "2024-01-01T24:00:00Z", "2024-01-01T00:60:00Z", "2024-01-01 00:00:00Z",
                           "2024-01-01T00:00:00", "2024-1-01T00:00:00Z", "1969-12-31T23:59:59Z",
                           "2038-01-01T00:00:00Z", "2024-01-01T00:00:00Zx"}) {
    EXPECT_FALSE(ParseUtc(text)) << text;
  }
}

}  // namespace
}  // namespace tera
