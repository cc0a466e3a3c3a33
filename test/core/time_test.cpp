#include "core/time.h"

#include <gtest/gtest.h>

namespace tera {
namespace {

TEST(SampleClock, ThirtyHertzDoesNotDrift) {
  const SampleClock clock{.rate_hz = 30};
  EXPECT_EQ(clock.Due(1), 33333333);
  EXPECT_EQ(clock.Due(3), 100000000);
  EXPECT_EQ(clock.Due(30 * 86400), 86400 * kNsPerSecond);
}

TEST(SampleClock, CountsFromItsStart) {
  const SampleClock clock{.rate_hz = 200, .start_ns = 17};
  EXPECT_EQ(clock.Due(0), 17);
  EXPECT_EQ(clock.Due(2), 10000017);
  EXPECT_EQ(clock.Period(), 5000000);
}

}  // namespace
}  // namespace tera
