#include "layout/compare/compare_layouts.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/error.h"

namespace tera {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;
using Verdict = Difference::Verdict;

constexpr double kPeriod_s = 0.2;

/// A figure in metres.
FigureId IdOf(std::size_t f, bool more_is_better = true) {
  return {more_is_better ? Measure::kDetectedTo : Measure::kDetectedFrom, fmt::format("f{}", f), 0};
}

/// A report of these figures over moments every 0.2 s.
LayoutReport ReportOf(const std::string& name, const std::vector<std::vector<double>>& figures,
                      double error = 0, bool more_is_better = true) {
  LayoutReport report;
  report.name = name;
  report.cycle = "base";
  for (std::size_t m = 0; m < figures.front().size(); ++m) {
    report.t_s.push_back(kPeriod_s * static_cast<double>(m));
  }
  for (std::size_t f = 0; f < figures.size(); ++f) {
    Figure figure{IdOf(f, more_is_better), figures[f]};
    if (error > 0) figure.error.assign(figures[f].size(), error);
    report.figures.push_back(figure);
  }
  return report;
}

std::vector<double> Zeros(std::size_t n) { return std::vector<double>(n, 0.0); }

/// A stationary series of zero mean and unit variance; `phi` correlates successive values.
std::vector<double> Series(std::size_t n, double phi, std::mt19937_64* random) {
  std::normal_distribution<double> normal;
  std::vector<double> series = {normal(*random)};
  while (series.size() < n) {
    series.push_back(phi * series.back() + std::sqrt(1 - phi * phi) * normal(*random));
  }
  return series;
}

/// Number of undecided ones among `trials` series that differ from zero only by noise.
int Undecided(int trials, std::size_t n, double phi, double block_s) {
  std::mt19937_64 random(20240917);
  std::vector<std::vector<double>> noise, zeros;
  for (int t = 0; t < trials; ++t) {
    noise.push_back(Series(n, phi, &random));
    zeros.push_back(Zeros(n));
  }
  int undecided = 0;
  for (const Difference& d : Compare(ReportOf("a", zeros), ReportOf("b", noise), block_s)) {
    undecided += d.verdict() == Verdict::kUndecided;
  }
  return undecided;
}

TEST(LayoutComparison, OfALayoutWithItselfIsNoDifference) {
  std::mt19937_64 random(1);
  for (const double error : {0.0, 0.1}) {
    const LayoutReport report = ReportOf("a", {Series(30, 0.5, &random), Zeros(30)}, error);
    for (const Difference& d : Compare(report, report)) {
      EXPECT_EQ(d.low, 0);
      EXPECT_EQ(d.high, 0);
      EXPECT_EQ(d.of_first, d.of_other);
      EXPECT_EQ(d.verdict(), Verdict::kUndecided);
    }
  }
}

TEST(LayoutComparison, ADifferenceBeyondAllErrorsIsDecided) {
  std::mt19937_64 random(2);
  const std::vector<double> first = Series(50, 0.5, &random);
  std::vector<double> other = first;
  for (double& value : other) value += 0.1;
  // Errors belong to the tested places, equal at all moments: they do not average out, and the
  // difference has an error of 0.01 sqrt(2).
  const Difference d = Compare(ReportOf("a", {first}, 0.01), ReportOf("b", {other}, 0.01)).front();
  EXPECT_EQ(d.figure, IdOf(0));
  EXPECT_NEAR(d.of_other - d.of_first, 0.1, 1e-12);
  EXPECT_EQ(d.verdict(), Verdict::kBetter);
  EXPECT_NEAR(d.low, 0.1 - 1.96 * 0.01 * std::sqrt(2), 1e-4);
  EXPECT_NEAR(d.high, 0.1 + 1.96 * 0.01 * std::sqrt(2), 1e-4);
  const Difference back =
      Compare(ReportOf("b", {other}, 0.01), ReportOf("a", {first}, 0.01)).front();
  EXPECT_EQ(back.verdict(), Verdict::kWorse);
  EXPECT_NEAR(back.high, 0 - d.low, 1e-9);
}

TEST(LayoutComparison, ADifferenceWithinTheErrorsIsUndecided) {
  std::vector<double> ones(50, 1.0);
  const Difference d = Compare(ReportOf("a", {Zeros(50)}, 0.5), ReportOf("b", {ones}, 0.5)).front();
  // 1.96 x 0.5 sqrt(2) = 1.386.
  EXPECT_EQ(d.verdict(), Verdict::kUndecided);
  EXPECT_NEAR(d.high, 2.386, 0.001);
}

TEST(LayoutComparison, LessIsBetterWhereTheFigureSaysSo) {
  const std::vector<double> ones(20, 1.0);
  EXPECT_EQ(Compare(ReportOf("a", {Zeros(20)}, 0, false), ReportOf("b", {ones}, 0, false))
                .front()
                .verdict(),
            Verdict::kWorse);
  EXPECT_EQ(Compare(ReportOf("a", {ones}, 0, false), ReportOf("b", {Zeros(20)}, 0, false))
                .front()
                .verdict(),
            Verdict::kBetter);
}

// An interval from k blocks underestimates the variance by 1/k, since it is about the series' own
// mean, and it rests on k values. A share P(|t| < 1.96 sqrt(1 - 1/k)) of trials, t with k - 1
// degrees of freedom, is undecided. For two minutes in blocks of 2 s, that is 94.3 %.
TEST(LayoutComparison, NoiseIsUndecidedInNineteenOfTwentyTrials) {
  constexpr int kTrials = 100;
  const int undecided = Undecided(kTrials, 600, 0, 2.0);
  // Down to 3.5 standard deviations of a count. The probability that none of 100 is decided is
  // 0.943^100 = 0.3 %.
  EXPECT_GE(undecided, 0.943 * kTrials - 3.5 * std::sqrt(kTrials * 0.943 * 0.057));
  EXPECT_LT(undecided, kTrials);
}

// The correlation of the series decays by phi a moment. Blocks of b moments hold a share 1 - 2 phi
// / ((1 - phi^2) b) of the variance of the mean (Kuensch 1989; Lahiri 2003, ch. 5), single moments
// (1 - phi) / (1 + phi). For phi = exp(-0.4), a decay in 0.5 s, and b = 10, these are 0.757 and
// 0.197. A normal value lies within 1.96 sqrt of them with a probability of 90.7 and 61.6 %.
TEST(LayoutComparison, MomentsThatAreAlikeAreTakenInBlocks) {
  constexpr int kTrials = 100;
  const double phi = std::exp(-0.4);
  EXPECT_GE(Undecided(kTrials, 600, phi, 2.0),
            0.9 * kTrials - 3.5 * std::sqrt(kTrials * 0.9 * 0.1));
  EXPECT_LE(Undecided(kTrials, 600, phi, kPeriod_s),
            0.616 * kTrials + 3.5 * std::sqrt(kTrials * 0.616 * 0.384));
}

TEST(LayoutComparison, AShortCycleStaysHonestWithinWhatItsFewBlocksCanDo) {
  // 12 s: six blocks. Likewise P(|t5| < 1.96 sqrt(5/6)) = 86.6 %.
  constexpr int kTrials = 400;
  EXPECT_GE(Undecided(kTrials, 60, 0, 2.0),
            0.866 * kTrials - 3.5 * std::sqrt(kTrials * 0.866 * 0.134));
}

TEST(LayoutComparison, ADifferenceThatNoiseHidesInEachIsSeenSinceMomentsAreTheSame) {
  std::mt19937_64 random(5);
  const std::vector<double> first = Series(100, 0.9, &random);
  std::vector<double> other = first;
  std::normal_distribution<double> small(0.05, 0.05);
  for (double& value : other) value += small(random);
  // Ten blocks or more: the error of the mean difference is about 0.05 / sqrt(100).
  const Difference d = Compare(ReportOf("a", {first}), ReportOf("b", {other})).front();
  EXPECT_EQ(d.verdict(), Verdict::kBetter);
  EXPECT_LT(d.high - d.low, 0.05);
  EXPECT_LT(d.low, d.of_other - d.of_first);
  EXPECT_GT(d.high, d.of_other - d.of_first);
}

TEST(LayoutComparison, IsTheSameEveryTime) {
  std::mt19937_64 random(6);
  const LayoutReport a = ReportOf("a", {Series(40, 0.5, &random)}),
                     b = ReportOf("b", {Series(40, 0.5, &random)});
  const Difference one = Compare(a, b).front(), again = Compare(a, b).front();
  EXPECT_EQ(one.low, again.low);
  EXPECT_EQ(one.high, again.high);
}

TEST(LayoutComparison, OtherQuestionsAreRefused) {
  const LayoutReport a = ReportOf("a", {Zeros(4)});
  LayoutReport b = ReportOf("b", {Zeros(4)});
  b.asked_sha256 = "another study";
  EXPECT_THROW(Compare(a, b), InputError);
}

TEST(LayoutComparison, WhatIsSeenOfAZoneIsDecidedOnlyWhereWhatIsNotIsTooAndBack) {
  // The volume differs by 1 m^3 in 10 at every moment, the share by less than its places resolve.
  std::vector<double> ones(50, 1.0), more(50, 0.51), less(50, 0.5);
  const auto report = [&](const std::string& name, const std::vector<double>& seen,
                          const std::vector<double>& blind_m3, double error) {
    LayoutReport r = ReportOf(name, {seen, blind_m3});
    r.figures[0].id = {Measure::kSeenBy1, "dig"};
    r.figures[0].error.assign(seen.size(), error);
    r.figures[1].id = {Measure::kBlindVolume, "dig"};
    return r;
  };
  const auto verdicts = [&](double error) {
    std::vector<Verdict> of;
    for (const Difference& d :
         Compare(report("a", less, ones, error), report("b", more, Zeros(50), error))) {
      of.push_back(d.verdict());
    }
    return of;
  };
  EXPECT_EQ(verdicts(0.02), (std::vector{Verdict::kUndecided, Verdict::kUndecided}));
  EXPECT_EQ(verdicts(0.001), (std::vector{Verdict::kBetter, Verdict::kBetter}));
}

TEST(LayoutComparison, AnotherStudyOverOneCycleIsSaidToBeThat) {
  const LayoutReport a = ReportOf("a", {Zeros(4)});
  LayoutReport b = ReportOf("b", {Zeros(5)});
  b.asked_sha256 = "another study";
  EXPECT_THAT([&] { Compare(a, b); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("different studies or scenarios"),
                                              testing::Not(HasSubstr("moments")))));
}

TEST(LayoutComparison, OneMomentDecidesNothing) {
  const Difference d = Compare(ReportOf("a", {Zeros(1)}, 0.1), ReportOf("b", {{1.0}}, 0.1)).front();
  EXPECT_EQ(d.verdict(), Verdict::kUndecided);
  EXPECT_NEAR(d.high, 1 + 1.96 * 0.1 * std::sqrt(2), 1e-3);
}

TEST(LayoutComparison, TwoMomentsThatAgreeAreEnough) {
  for (const std::size_t n : {2, 3}) {
    const std::vector<double> ones(n, 1.0);
    const Difference d =
        Compare(ReportOf("a", {Zeros(n)}, 0.1), ReportOf("b", {ones}, 0.1)).front();
    EXPECT_NEAR(d.low, 1 - 1.96 * 0.1 * std::sqrt(2), 1e-3) << n;
    EXPECT_NEAR(d.high, 1 + 1.96 * 0.1 * std::sqrt(2), 1e-3) << n;
    EXPECT_EQ(d.verdict(), Verdict::kBetter) << n;
  }
}

TEST(LayoutComparison, BlocksLongerThanTheCycleAreNoFault) {
  std::mt19937_64 random(7);
  const Difference d =
      Compare(ReportOf("a", {Zeros(6)}), ReportOf("b", {Series(6, 0, &random)}), 1000).front();
  EXPECT_TRUE(std::isfinite(d.low) && std::isfinite(d.high));
  EXPECT_LE(d.low, d.high);
}

TEST(LayoutComparison, FiguresThatOneHasNotAreLeftOut) {
  const LayoutReport a = ReportOf("a", {Zeros(4), Zeros(4), Zeros(4)});
  LayoutReport b = ReportOf("b", {Zeros(4), Zeros(4)});
  b.figures[1].id = IdOf(7);
  std::swap(b.figures[0], b.figures[1]);
  const std::vector<Difference> differences = Compare(a, b);
  ASSERT_EQ(differences.size(), 1u);
  EXPECT_EQ(differences[0].figure, IdOf(0));
}

TEST(LayoutComparison, OtherCyclesOrMomentsAreRefused) {
  const LayoutReport a = ReportOf("a", {Zeros(4)});
  LayoutReport b = ReportOf("b", {Zeros(4)});
  b.cycle = "elsewhere";
  EXPECT_THAT(
      [&] { Compare(a, b); },
      ThrowsMessage<InputError>(AllOf(HasSubstr("'a'"), HasSubstr("'b'"), HasSubstr("elsewhere"))));
  b = ReportOf("b", {Zeros(5)});
  EXPECT_THROW(Compare(a, b), InputError);
  b = ReportOf("b", {Zeros(4)});
  b.t_s[2] += 0.01;
  EXPECT_THROW(Compare(a, b), InputError);
}

}  // namespace
}  // namespace tera
