#include "diagnose/statistics/hypothesis_tests/heterogeneity.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tera {
namespace {

TEST(Pool, OfOneValueIsThatValue) {
  const PooledNumber one = Pool({{0.3, 0.02}});
  EXPECT_EQ(one.value, 0.3);
  EXPECT_DOUBLE_EQ(one.sigma, 0.02);
  EXPECT_EQ(one.between, 0);
  EXPECT_EQ(one.p, 1);
}

// Consistent values have the weights 1 / sigma^2: (100 * 1 + 25 * 1.1) / 125.
TEST(Pool, WeighsValuesThatAgreeByTheirErrors) {
  const PooledNumber pooled = Pool({{1, 0.1}, {1.1, 0.2}});
  EXPECT_NEAR(pooled.value, 127.5 / 125, 1e-12);
  EXPECT_NEAR(pooled.sigma, std::sqrt(1 / 125.0), 1e-12);
  EXPECT_EQ(pooled.between, 0);
}

// Q = 2 with one degree of freedom: p = erfc(1). tau^2 = (2 - 1) / (200 - 20000 / 200) = 0.01.
TEST(Pool, KnowsByHowMuchTwoValuesDifferBeyondTheirErrors) {
  const PooledNumber pooled = Pool({{1, 0.1}, {1.2, 0.1}});
  EXPECT_NEAR(pooled.p, std::erfc(1.0), 1e-9);
  EXPECT_NEAR(pooled.between, 0.1, 1e-12);
  EXPECT_NEAR(pooled.value, 1.1, 1e-12);
  EXPECT_NEAR(pooled.sigma, 0.1, 1e-12);
}

// The thirteen trials of BCG vaccine (Colditz et al. 1994) as log risk ratios. Textbooks give Q =
// 152.23 and the estimate of DerSimonian and Laird, -0.7141 +- 0.1787 with tau^2 = 0.3088.
TEST(Pool, GivesThePublishedAnswerForThirteenTrials) {
  constexpr double kTrials[13][4] = {
      {4, 119, 11, 128},       {6, 300, 29, 274},        {3, 228, 11, 209},
      {62, 13536, 248, 12619}, {33, 5036, 47, 5761},     {180, 1361, 372, 1079},
      {8, 2537, 10, 619},      {505, 87886, 499, 87892}, {29, 7470, 45, 7232},
      {17, 1699, 65, 1600},    {186, 50448, 141, 27197}, {5, 2493, 3, 2338},
      {27, 16886, 29, 17825}};
  std::vector<UncertainNumber> ratios;
  for (const auto& [ill, well, ill_without, well_without] : kTrials) {
    const double all = ill + well, all_without = ill_without + well_without;
    ratios.push_back({std::log(ill / all / (ill_without / all_without)),
                      std::sqrt(1 / ill - 1 / all + 1 / ill_without - 1 / all_without)});
  }
  const PooledNumber pooled = Pool(ratios);
  EXPECT_NEAR(pooled.value, -0.7141, 1e-4);
  EXPECT_NEAR(pooled.sigma, 0.1787, 1e-4);
  EXPECT_NEAR(pooled.between * pooled.between, 0.3088, 1e-4);
  EXPECT_LT(pooled.p, 1e-20);
}

}  // namespace
}  // namespace tera
