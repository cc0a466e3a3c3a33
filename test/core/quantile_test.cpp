#include "core/quantile.h"

#include <gtest/gtest.h>

namespace tera {
namespace {

TEST(Quantile, LiesBetweenTheTwoSamplesAroundItsPlace) {
  // Places of four samples: 0, 1/3, 2/3 and 1.
  const std::vector<double> values{40, 10, 30, 20};
  EXPECT_EQ(Quantile(values, 0), 10);
  EXPECT_NEAR(Quantile(values, 0.5), 25, 1e-12);
  EXPECT_NEAR(Quantile(values, 0.75), 32.5, 1e-12);
  EXPECT_EQ(Quantile(values, 1), 40);
}

TEST(Median, OfAnOddNumberIsTheMiddleOneWhateverTheOrder) {
  EXPECT_EQ(Median<double>({7, -2, 100}), 7);
  EXPECT_EQ(Median<float>({5}), 5);
}

TEST(Median, OfWholeNumbersIsOneToo) {
  const std::int64_t day_ns = 86'400'000'000'000;
  EXPECT_EQ(Median<std::int64_t>({day_ns + 3, day_ns, day_ns + 1}), day_ns + 1);
  EXPECT_EQ(Median<std::int64_t>({4, 1}), 2);
}

}  // namespace
}  // namespace tera
