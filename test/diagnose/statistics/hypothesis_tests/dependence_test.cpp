#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>

#include "core/units.h"
#include "diagnose/statistics/regime/partialling.h"
#include "diagnose/statistics/series/simulated.h"
#include "diagnose/statistics/series/whitening.h"

namespace tera {
namespace {

constexpr std::size_t kSize = 4000;
constexpr int kRuns = 400;

/// Rejections at 5 % and 1 % by test.
struct Rejections {
  std::map<std::string, int> at_5, at_1;

  void Count(const std::string& test, double p) {
    at_5[test] += p <= 0.05;
    at_1[test] += p <= 0.01;
  }
};

/// A recording without effects: noise with dropouts, a noise model fitted to it, unrelated inputs.
struct NullRecording {
  explicit NullRecording(std::uint64_t seed)
      : residual(WithDropouts(NoiseSeries(StubbornNoise(), kSize, Stream(seed, "noise")), 0.02,
                              Stream(seed, "dropouts"))),
        noise(FitNoise(residual, {.highest_order = 3})),
        lever(LeverSeries(kSize, Stream(seed, "lever"))),
        drift(NoiseSeries(StubbornNoise(), kSize, Stream(seed, "drift"))) {}

  Series residual;
  NoiseModel noise;
  Series lever, drift;
};

void TestOne(std::uint64_t seed, Rejections* out) {
  const NullRecording null(seed);
  const Stream stream(seed, "shifts");
  const WhiteningFilter filter(null.noise, null.residual.valid);
  const RegimeDesign design(null.residual, null.noise, Eigen::MatrixXd());
  for (const auto& [name, series] : {std::pair{"lever", null.lever}, {"drift", null.drift}}) {
    const RegimeTestResult test =
        TestRegime(design, RegimeProbe({name, series}, filter), {}, stream);
    out->Count("regime, " + test.name, test.comparison.p);
    out->Count("regime, " + test.name + ", tail", test.comparison.p_tail);
  }
  const Series& simulated = null.lever;
  Eigen::MatrixXd known(static_cast<Eigen::Index>(kSize), 1);
  known.col(0) = Eigen::Map<const Eigen::VectorXd>(simulated.value.data(), known.rows());
  const RegimeDesign beyond_gain(null.residual, null.noise, known);
  const RegimeProbe share({.name = "drift, share", .series = null.drift, .times = simulated.value},
                          filter);
  const RegimeTestResult test = TestRegime(beyond_gain, share, {}, stream);
  out->Count("regime, " + test.name, test.comparison.p);
  out->Count("regime, " + test.name + ", tail", test.comparison.p_tail);
}

TEST(Dependence, TestsRejectNoMoreThanTheyPromiseUnderStubbornNoise) {
  Rejections rejections;
  for (std::uint64_t seed = 0; seed < kRuns; ++seed) TestOne(seed, &rejections);
  for (const auto& [test, count] : rejections.at_5) {
    std::printf("%-36s rejected at 5 %%: %4.1f %%, at 1 %%: %4.1f %%\n", test.c_str(),
                100.0 * count / kRuns, 100.0 * rejections.at_1[test] / kRuns);
    // 5 % and two standard errors of 400 runs (1.1 %); 1 % and four (0.5 %).
    EXPECT_LE(count, 0.072 * kRuns) << test;
    EXPECT_LE(rejections.at_1[test], 0.03 * kRuns) << test;
  }
}

TEST(Dependence, SelectionAmongTenVariablesOfNothingSeldomTakesAny) {
  int taken = 0;
  const int runs = 150;
  for (std::uint64_t seed = 0; seed < runs; ++seed) {
    const NullRecording null(1000 + seed);
    std::vector<RegimeVariable> variables;
    for (int v = 0; v < 10; ++v) {
      const Stream stream(seed, "variable" + std::to_string(v));
      variables.push_back(
          {"v", v % 2 ? LeverSeries(kSize, stream) : NoiseSeries(StubbornNoise(), kSize, stream)});
    }
    taken += !SelectRegimes(null.residual, null.noise, variables, {.alpha = 0.05},
                            Stream(seed, "shifts"))
                  .steps.empty();
  }
  std::printf("selection of any of 10 variables at 5 %%: %.1f %%\n", 100.0 * taken / runs);
  // 5 % and three standard errors of 150 runs.
  EXPECT_LE(taken, 0.103 * runs);
}

TEST(Dependence, RegimeTestFindsADeadBandThatIsATenthOfTheNoise) {
  int found = 0;
  const int runs = 40;
  for (std::uint64_t seed = 0; seed < runs; ++seed) {
    NullRecording null(2000 + seed);
    // Variance of the noise 2 / (1 - 0.95^2) = 20.5; that of the effect about 2.
    for (std::size_t k = 0; k < kSize; ++k) {
      if (!null.residual.valid[k]) continue;
      null.residual.value[k] -= 10 * std::clamp(null.lever.value[k], -0.18, 0.18);
    }
    const NoiseModel noise = FitNoise(null.residual, {.highest_order = 3});
    const RegimeDesign design(null.residual, noise, Eigen::MatrixXd());
    const WhiteningFilter filter(noise, null.residual.valid);
    found += TestRegime(design, RegimeProbe({"lever", null.lever}, filter), {}, Stream(seed, "s"))
                 .comparison.p <= 0.05;
  }
  std::printf("dead band of a tenth of the noise's variance found: %d of %d\n", found, runs);
  EXPECT_GE(found, 32);
}

/// A machine with 10 units a second at full lever, of which an effect removes a share.
class ShareOfTheSimulated : public testing::Test {
 protected:
  static constexpr std::size_t kOther = 0, kPlace = 1;

  ShareOfTheSimulated() : null_(4711) {
    const Series other = LeverSeries(kSize, Stream(1, "other"));
    std::vector<double> place(kSize), simulated(kSize);
    for (std::size_t k = 0; k < kSize; ++k) {
      simulated[k] = 30 * null_.lever.value[k];
      const double t = static_cast<double>(k);
      place[k] = std::sin(0.013 * t) + 0.6 * std::sin(0.0071 * t + 1) + 0.3 * std::sin(0.031 * t);
    }
    for (const Series& series : {other, MakeSeries(0.01, place)}) {
      variables_.push_back({.name = "plain", .series = series});
    }
    for (std::size_t v = 0; v < 2; ++v) {
      variables_.push_back(variables_[v]);
      variables_.back().name = "share";
      variables_.back().times = simulated;
    }
  }

  template <typename Share>
  std::size_t FirstTold(const Share& share) {
    Series residual = null_.residual;
    for (std::size_t k = 0; k < kSize; ++k) {
      if (!residual.valid[k]) continue;
      residual.value[k] +=
          30 * null_.lever.value[k] *
          share(variables_[kOther].series.value[k], variables_[kPlace].series.value[k]);
    }
    const Partialling found = SelectRegimes(residual, FitNoise(residual, {.highest_order = 3}),
                                            variables_, {}, Stream(5, "shifts"));
    if (!found.steps.empty()) return found.steps.front().variable;
    // A place recurs too seldom for enough shifts: the variable that explains most, if any does.
    const auto best =
        std::max_element(found.left.begin(), found.left.end(),
                         [](const auto& a, const auto& b) { return a.criterion < b.criterion; });
    return best->criterion > 0.02 ? static_cast<std::size_t>(best - found.left.begin())
                                  : variables_.size();
  }

  NullRecording null_;
  std::vector<RegimeVariable> variables_;  ///< two plain, two as a share
};

TEST_F(ShareOfTheSimulated, ThatGoesWhileAnotherLeverIsOutIsToldByThatLever) {
  EXPECT_EQ(FirstTold([](double other, double) { return std::abs(other) > 0.1 ? -0.5 : 0.0; }), 2u);
}

TEST_F(ShareOfTheSimulated, ThatChangesWithThePlaceIsToldByThePlace) {
  EXPECT_EQ(FirstTold([](double, double place) { return 0.5 * place; }), 3u);
}

TEST_F(ShareOfTheSimulated, ThatIsTheSameEverywhereIsNoDependence) {
  EXPECT_EQ(FirstTold([](double, double) { return 0.5; }), variables_.size());
}

TEST(Shifts, AreAtLeastSoFarApartAsAsked) {
  const std::vector<std::size_t> shifts = CircularShifts(1000, 90, 200, Stream(2, "shifts"));
  ASSERT_EQ(shifts.size(), 9u);
  EXPECT_GE(shifts.front(), 90u);
  EXPECT_LE(shifts.back(), 910u);
  for (std::size_t k = 1; k < shifts.size(); ++k) EXPECT_GE(shifts[k], shifts[k - 1] + 90);
  EXPECT_TRUE(CircularShifts(100, 40, 200, Stream(2, "shifts")).empty());
}

TEST(Shifts, PCountsTheShiftsBeyond) {
  std::vector<double> shifted;
  for (int k = 1; k <= 99; ++k) shifted.push_back(k);
  EXPECT_DOUBLE_EQ(CompareWithShifts(95, shifted).p, 0.06);
  EXPECT_DOUBLE_EQ(CompareWithShifts(200, shifted).p, 0.01);
  EXPECT_DOUBLE_EQ(CompareWithShifts(3, {}).p, 1);
}

TEST(Shifts, TailOfAnExponentialDistributionIsContinued) {
  std::vector<double> shifted;
  for (int k = 0; k < 199; ++k) shifted.push_back(-std::log(1 - (k + 0.5) / 199));
  const ShiftComparison far = CompareWithShifts(std::log(1e6), shifted);
  EXPECT_DOUBLE_EQ(far.p, 1.0 / 200);
  // The mean excess of 39 values is known to 16 %; five of these, over 12 mean excesses.
  EXPECT_NEAR(std::log10(far.p_tail), -6, 1.5);
}

}  // namespace
}  // namespace tera
