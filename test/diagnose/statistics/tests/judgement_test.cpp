#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "core/random.h"
#include "diagnose/statistics/series/simulated.h"
#include "diagnose/statistics/tests/block_bootstrap.h"
#include "diagnose/statistics/tests/e_value.h"
#include "diagnose/statistics/tests/ljung_box.h"
#include "diagnose/statistics/tests/multiple_testing.h"
#include "diagnose/statistics/tests/proportion.h"
#include "diagnose/statistics/tests/signed_rank.h"
#include "diagnose/statistics/tests/variance_ratio.h"

namespace tera {
namespace {

/// 1 .. n, of which the given ranks are negative.
std::vector<double> Differences(int n, const std::vector<int>& negative) {
  std::vector<double> out(static_cast<std::size_t>(n));
  std::iota(out.begin(), out.end(), 1.0);
  for (const int rank : negative) out[static_cast<std::size_t>(rank - 1)] *= -1;
  return out;
}

TEST(SignedRank, SmallSamplesAreCounted) {
  EXPECT_DOUBLE_EQ(TestSignedRank(Differences(5, {})).p_greater, 1.0 / 32);
  EXPECT_DOUBLE_EQ(TestSignedRank(Differences(5, {})).p_two_sided, 1.0 / 16);
  // Sums 0 to 3 of distinct ranks: 1 + 1 + 1 + 2 of 256.
  EXPECT_DOUBLE_EQ(TestSignedRank(Differences(8, {1, 2})).p_greater, 5.0 / 256);
}

TEST(SignedRank, AgreesWithPublishedTables) {
  // Critical values of the smaller sum, one-sided 0.025 at n = 10: 8; 0.05 at n = 20: 60; 0.05 at
  // n = 50: 466 (Wilcoxon and Wilcox 1964).
  EXPECT_NEAR(TestSignedRank(Differences(10, {8})).p_greater, 0.0244, 5e-5);
  EXPECT_LE(TestSignedRank(Differences(20, {20, 19, 18, 3})).p_greater, 0.05);
  EXPECT_GT(TestSignedRank(Differences(20, {20, 19, 18, 4})).p_greater, 0.05);
  std::vector<int> of_466 = {16};
  for (int rank = 50; rank >= 42; --rank) of_466.push_back(rank);
  of_466.push_back(36);
  const SignedRank at = TestSignedRank(Differences(50, of_466));
  ASSERT_EQ(50 * 51 / 2 - at.positive_sum, 466);
  EXPECT_LE(at.p_greater, 0.05);
  of_466[0] = 17;
  EXPECT_GT(TestSignedRank(Differences(50, of_466)).p_greater, 0.05);
}

TEST(SignedRank, TiesShareTheirRankAndZerosAreLeftOut) {
  // Three equal sizes, two positive: as two heads or more of three coins.
  const SignedRank tied = TestSignedRank({0.5, 0, 0.5, -0.5, 0});
  EXPECT_EQ(tied.count, 3u);
  EXPECT_DOUBLE_EQ(tied.positive_sum, 4);
  EXPECT_DOUBLE_EQ(tied.p_greater, 0.5);
  EXPECT_DOUBLE_EQ(tied.p_less, 7.0 / 8);
  EXPECT_DOUBLE_EQ(TestSignedRank({0, 0}).p_two_sided, 1);
}

TEST(SignedRank, LargeSamplesFollowTheNormalDistribution) {
  // n = 51: mean 663, variance n (n + 1) (2 n + 1) / 24 = 106.69^2; a sum of 487 with its
  // continuity correction lies 1.645 standard deviations out.
  std::vector<int> of_487 = {40, 24};
  for (int rank = 51; rank >= 43; --rank) of_487.push_back(rank);
  const SignedRank test = TestSignedRank(Differences(51, of_487));
  ASSERT_EQ(51 * 52 / 2 - test.positive_sum, 487);
  EXPECT_FALSE(test.exact);
  EXPECT_NEAR(test.p_greater, 0.05, 1e-4);
  EXPECT_NEAR(test.p_two_sided, 0.1, 2e-4);
}

TEST(Holm, AdjustsAsInTheWorkedExample) {
  const std::vector<double> adjusted = HolmAdjusted({0.01, 0.04, 0.03, 0.005});
  const std::vector<double> expected = {0.03, 0.06, 0.06, 0.02};
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(adjusted[k], expected[k], 1e-12);
  EXPECT_EQ(HolmAdjusted({0.9, 0.8})[0], 1);
}

TEST(Wilson, AgreesWithNewcombesTable) {
  // Newcombe 1998, table I, method 3.
  const struct {
    std::size_t successes, trials;
    double low, high;
  } rows[] = {{81, 263, 0.2553, 0.3662},
              {15, 148, 0.0624, 0.1605},
              {0, 20, 0.0, 0.1611},
              {1, 29, 0.0061, 0.1718}};
  for (const auto& row : rows) {
    const Interval interval = WilsonInterval(row.successes, row.trials);
    EXPECT_NEAR(interval.low, row.low, 5e-5);
    EXPECT_NEAR(interval.high, row.high, 5e-5);
  }
}

TEST(EValue, MeanIsAtMostOneUnderTheNull) {
  // Normal of known variance; null: mean 0; alternative: the mean of the other half.
  const int runs = 4000, half = 10;
  double sum = 0, squares = 0;
  int rejected = 0;
  for (int run = 0; run < runs; ++run) {
    const Stream stream(static_cast<std::uint64_t>(run), "null");
    std::vector<HeldOutFold> folds;
    for (std::uint32_t fold = 0; fold < 2; ++fold) {
      double fitted = 0;
      for (std::uint64_t k = 0; k < half; ++k) fitted += stream.Gaussian(k, 1 - fold) / half;
      HeldOutFold held;
      for (std::uint64_t k = 0; k < half; ++k) {
        const double x = stream.Gaussian(k, fold);
        held.alternative_log_likelihood -= 0.5 * (x - fitted) * (x - fitted);
        held.null_log_likelihood -= 0.5 * x * x;
      }
      folds.push_back(held);
    }
    const EValue value = CombineFolds(folds);
    sum += std::exp(value.log_e);
    squares += std::exp(2 * value.log_e);
    rejected += value.p <= 0.05;
  }
  const double mean = sum / runs;
  EXPECT_LT(mean, 1 + 5 * std::sqrt(squares / runs - mean * mean) / std::sqrt(runs));
  EXPECT_LE(rejected, 0.05 * runs);
}

TEST(EValue, FoldsAreAveraged) {
  const EValue value = CombineFolds({{std::log(30.0), 0}, {1000 + std::log(10.0), 1000}});
  EXPECT_NEAR(value.log_e, std::log(20.0), 1e-9);
  EXPECT_NEAR(value.p, 0.05, 1e-9);
}

TEST(Bootstrap, IntervalOfAMeanHasTheTextbookWidth) {
  const Stream stream(11, "draws");
  std::vector<double> sum(400), one(400, 1.0);
  for (std::size_t k = 0; k < sum.size(); ++k) sum[k] = 3 + stream.Gaussian(k);
  const Interval interval = BootstrapRatio(sum, one, 0.9, 2000, Stream(11, "bootstrap"));
  const double half = 1.645 / 20;  // sigma 1, n 400
  EXPECT_NEAR((interval.high - interval.low) / 2, half, 0.15 * half);
  EXPECT_NEAR((interval.high + interval.low) / 2, 3, 5.0 / 20);
}

TEST(Bootstrap, BlocksCoverEverythingOnce) {
  const std::vector<Segment> blocks = CutIntoBlocks(103, 20);
  EXPECT_EQ(blocks.size(), 5u);
  EXPECT_EQ(blocks.back(), (Segment{80, 103}));
  EXPECT_EQ(CutIntoBlocks(115, 20).size(), 6u);
  EXPECT_EQ(CutIntoBlocks(3, 20).front(), (Segment{0, 3}));
}

TEST(LjungBox, StatisticOfAnAlternatingSeriesIsInClosedForm) {
  std::vector<double> x(100);
  for (std::size_t k = 0; k < x.size(); ++k) x[k] = k % 2 ? -2 : 2;
  // r_1 = -99/100, Q = n (n + 2) r_1^2 / (n - 1).
  EXPECT_NEAR(LjungBox(MakeSeries(1, x), 1).statistic, 100 * 102 * 0.99 * 0.99 / 99, 1e-9);
}

TEST(LjungBox, PIsTheChiSquareTail) {
  // Two degrees of freedom: the tail is exp(-Q / 2).
  const LjungBoxResult result = LjungBox(NoiseSeries({.dof = 30}, 500, Stream(12, "white")), 3, 1);
  EXPECT_EQ(result.degrees_of_freedom, 2);
  EXPECT_NEAR(result.p, std::exp(-result.statistic / 2), 1e-9);
}

TEST(LjungBox, PairsOverGapsAreLeftOut) {
  Series series = NoiseSeries({.dof = 30}, 4000, Stream(13, "white"));
  for (std::size_t k = 0; k < series.size(); k += 2) series.valid[k] = 0;
  // No two neighbours are left: lag 1 contributes nothing.
  EXPECT_EQ(LjungBox(series, 1).statistic, 0);
  EXPECT_GT(LjungBox(series, 2).statistic, 0);
}

TEST(VarianceRatio, IsTheRatioOfVariances) {
  Series loud = NoiseSeries({.dof = 200}, 20000, Stream(14, "loud"));
  const Series quiet = NoiseSeries({.dof = 200}, 20000, Stream(14, "quiet"));
  for (double& x : loud.value) x *= 1.2;
  const VarianceRatioResult result = VarianceRatio(loud, quiet);
  // Relative standard error sqrt(2 / n + 2 / n) = 1.4 %.
  EXPECT_NEAR(result.ratio, 1.44, 0.1);
  EXPECT_LT(result.p, 1e-6);
  EXPECT_GT(VarianceRatio(quiet, loud).p, 0.999);
}

}  // namespace
}  // namespace tera
