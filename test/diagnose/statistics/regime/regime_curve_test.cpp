#include "diagnose/statistics/regime/regime_curve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/units.h"
#include "diagnose/statistics/regime/curve_shape.h"
#include "diagnose/statistics/regime/partialling.h"
#include "diagnose/statistics/series/simulated.h"

namespace tera {
namespace {

constexpr std::size_t kSize = 12000;
using Law = std::function<double(double)>;

/// Noise plus a law of the variable, with dropouts.
Series Residual(const Law& law, const Series& variable, std::uint64_t seed) {
  Series out = NoiseSeries(StubbornNoise(), variable.size(), Stream(seed, "noise"));
  for (std::size_t k = 0; k < out.size(); ++k) out.value[k] += law(variable.value[k]);
  return WithDropouts(std::move(out), 0.02, Stream(seed, "dropouts"));
}

RegimeCurve Fit(const Law& law, const Series& variable, std::uint64_t seed, bool angle = false) {
  return FitRegimeCurve(Residual(law, variable, seed), StubbornNoise(), Eigen::MatrixXd(),
                        {"x", variable, angle}, Stream(seed, "band"));
}

CurveShape Shape(const Law& law, std::uint64_t seed = 21) {
  return ClassifyCurve(Fit(law, LeverSeries(kSize, Stream(seed, "lever")), seed));
}

TEST(RegimeCurve, FollowsTheLawWithinItsBand) {
  const Law law = [](double x) { return 3 * std::sin(3 * x); };
  int held = 0;
  const int runs = 40;
  for (std::uint64_t seed = 0; seed < runs; ++seed) {
    const Series lever = LeverSeries(kSize / 2, Stream(seed, "lever"));
    const RegimeCurve curve = Fit(law, lever, seed);
    double mean = 0;
    for (Eigen::Index b = 0; b < curve.at.size(); ++b) {
      mean += curve.count[b] * law(curve.at[b]) / curve.count.sum();
    }
    bool inside = true;
    for (Eigen::Index b = 0; b < curve.at.size(); ++b) {
      const double truth = law(curve.at[b]) - mean;
      inside = inside && (curve.count[b] == 0 || (truth > curve.low[b] && truth < curve.high[b]));
    }
    held += inside;
  }
  // Nominal 90 %; the band excludes the bias of smoothing. Binomial, 5 standard errors: 9.5.
  EXPECT_GE(held, 36 - 10);
}

TEST(RegimeCurve, ExplainedShareIsThatOfTheVariance) {
  const Series lever = LeverSeries(kSize, Stream(31, "lever"));
  const Law law = [](double x) { return 8 * x; };
  const Series residual = Residual(law, lever, 31);
  double of_law = 0, all = 0;
  for (std::size_t k = 0; k < kSize; ++k) {
    of_law += residual.valid[k] * std::pow(law(lever.value[k]), 2);
    all += std::pow(residual.value[k], 2);
  }
  EXPECT_NEAR(Fit(law, lever, 31).explained_share, of_law / all, 0.1);
}

TEST(CurveShape, DeadBandErrorSaturatesWithinTheLeverItLivesIn) {
  const CurveShape shape = Shape([](double x) { return -20 * std::clamp(x, -0.2, 0.2); });
  EXPECT_EQ(NameOf(shape.form), "saturating");
  EXPECT_EQ(NameOf(shape.parity), "odd");
  EXPECT_NEAR(shape.bend, 0.2, 0.05);
  EXPECT_NEAR(shape.low, -0.2, 0.05);
  EXPECT_NEAR(shape.high, 0.2, 0.05);
  EXPECT_NEAR(shape.slope, -20, 5);
}

TEST(CurveShape, NamesTheFormsApart) {
  EXPECT_EQ(NameOf(Shape([](double x) { return 6 * x; }).form), "linear");
  EXPECT_EQ(NameOf(Shape([](double x) { return 6 * std::abs(x); }).parity), "even");
  EXPECT_EQ(NameOf(Shape([](double x) { return 8 * x * x; }).form), "smooth");
  EXPECT_EQ(NameOf(Shape([](double x) {
                     return 20 * (std::max(x - 0.4, 0.0) + std::min(x + 0.4, 0.0));
                   }).form),
            "threshold");
  EXPECT_EQ(NameOf(Shape([](double x) { return x > 0.3 ? 6.0 : 0.0; }).form), "step");
  EXPECT_EQ(NameOf(Shape([](double x) { return std::abs(x) < 0.25 ? 30 * x : 0; }).form), "local");
  EXPECT_EQ(NameOf(Shape([](double) { return 0.0; }).form), "none");
}

TEST(CurveShape, ThresholdLivesOutsideOfItsBend) {
  const CurveShape shape =
      Shape([](double x) { return 20 * (std::max(x - 0.4, 0.0) + std::min(x + 0.4, 0.0)); });
  EXPECT_TRUE(shape.outside);
  EXPECT_NEAR(shape.high, 0.4, 0.06);
  EXPECT_EQ(NameOf(shape.parity), "odd");
}

TEST(CurveShape, SineOfAnAngleIsPeriodicWithItsHarmonic) {
  const Stream stream(41, "angle");
  std::vector<double> angle(kSize);
  for (std::size_t k = 0; k < kSize; ++k) {
    angle[k] = 0.006 * static_cast<double>(k) + std::sin(0.0017 * static_cast<double>(k));
  }
  const CurveShape shape = ClassifyCurve(
      Fit([](double x) { return 6 * std::sin(2 * x + 0.4); }, MakeSeries(0.01, angle), 41, true));
  EXPECT_EQ(NameOf(shape.form), "periodic");
  EXPECT_EQ(shape.bend, 2);
}

TEST(Partialling, TakesWhatExplainsAndLeavesWhatOnlyFollowsIt) {
  const Series lever = LeverSeries(kSize, Stream(51, "lever"));
  const Series other = LeverSeries(kSize, Stream(51, "other"));
  Series follower = lever;  // the lever, seen through noise
  for (std::size_t k = 0; k < kSize; ++k) {
    follower.value[k] += 0.05 * Stream(51, "follower").Gaussian(k);
  }
  const Series bystander = LeverSeries(kSize, Stream(51, "bystander"));
  Series residual = Residual([](double x) { return 6 * x; }, lever, 51);
  for (std::size_t k = 0; k < kSize; ++k) {
    if (residual.valid[k]) residual.value[k] += 4 * std::abs(other.value[k]);
  }
  const Partialling found = SelectRegimes(
      residual, StubbornNoise(),
      {{"follower", follower}, {"bystander", bystander}, {"lever", lever}, {"other", other}}, {},
      Stream(51, "shifts"));
  ASSERT_EQ(found.steps.size(), 2u);
  EXPECT_EQ(found.steps[0].variable, 2u);
  EXPECT_EQ(found.steps[1].variable, 3u);
  EXPECT_LT(found.steps[0].tests[0].comparison.p, 0.01);  // at first the follower is significant
                                                          // too
  EXPECT_GT(found.left[0].comparison.p, 0.01);
  EXPECT_GT(found.left[1].comparison.p, 0.01);
}

TEST(RegimeTest, VariableThatNeverMovesSaysNothing) {
  const Series still = MakeSeries(0.01, std::vector<double>(2000, 0.3));
  const Series residual = NoiseSeries(StubbornNoise(), 2000, Stream(61, "noise"));
  const Partialling found =
      SelectRegimes(residual, StubbornNoise(), {{"still", still}}, {}, Stream(61, "shifts"));
  EXPECT_TRUE(found.steps.empty());
  EXPECT_EQ(found.left[0].comparison.p, 1);
}

}  // namespace
}  // namespace tera
