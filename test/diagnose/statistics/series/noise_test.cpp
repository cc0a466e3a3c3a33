#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "core/units.h"
#include "diagnose/statistics/series/robust.h"
#include "diagnose/statistics/series/simulated.h"
#include "diagnose/statistics/series/whitening.h"

namespace tera {
namespace {

// Poles of modulus sqrt(0.9), a resonance.
const NoiseModel kResonant{.ar = {1.6, -0.9}, .scale = 0.3, .dof = 5};

TEST(Series, GapsAreWhatIsNotFinite) {
  const Series series = MakeSeries(0.5, {1, NAN, 3, 4, INFINITY, 6});
  EXPECT_EQ(SegmentsOf(series.valid), (std::vector<Segment>{{0, 1}, {2, 4}, {5, 6}}));
  EXPECT_EQ(SegmentsOf(series.valid, 2), (std::vector<Segment>{{2, 4}}));
  EXPECT_EQ(BridgedValues(series), (std::vector<double>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(ValidValues(series), (std::vector<double>{1, 3, 4, 6}));
}

TEST(Series, EndsWithoutSamplesAreHeld) {
  const Series series = MakeSeries(0.5, {NAN, 2, NAN});
  EXPECT_EQ(BridgedValues(series), (std::vector<double>{2, 2, 2}));
}

TEST(Robust, ScaleOfANormalSampleIsItsStandardDeviationDespiteOutliers) {
  const Stream stream(3, "normal");
  std::vector<double> x(10000);
  for (std::size_t k = 0; k < x.size(); ++k) x[k] = 7 + 2 * stream.Gaussian(k);
  for (std::size_t k = 0; k < 100; ++k) x[k] = 1e6;
  // Standard error of the median absolute deviation: 1.17 sigma / sqrt(n); 1 % of outliers move it
  // by 1.2 %.
  EXPECT_NEAR(RobustScale(x), 2, 0.025 + 5 * 1.17 * 2 / 100);
}

TEST(Noise, FitFindsOrderCoefficientsScaleAndTailsDespiteDropouts) {
  const std::size_t n = 20000;
  const Series series =
      WithDropouts(NoiseSeries(kResonant, n, Stream(5, "noise")), 0.05, Stream(5, "dropouts"));
  ASSERT_LT(CountValid(series.valid), 0.97 * n);
  const NoiseModel fitted = FitNoise(series);
  ASSERT_EQ(fitted.order(), 2u);
  // Asymptotic standard error sqrt((1 - phi2^2) / n) = 0.0031; n falls to two thirds by the gaps.
  EXPECT_NEAR(fitted.ar[0], 1.6, 0.02);
  EXPECT_NEAR(fitted.ar[1], -0.9, 0.02);
  EXPECT_NEAR(fitted.scale, 0.3, 0.02);
  EXPECT_NEAR(fitted.dof, 5, 1.2);
}

TEST(Noise, OutliersDoNotMoveTheFit) {
  NoiseModel wild = kResonant;
  wild.dof = 1.6;
  const NoiseModel fitted = FitNoise(NoiseSeries(wild, 20000, Stream(6, "wild")), {.order = 2});
  EXPECT_NEAR(fitted.ar[0], 1.6, 0.01);
  EXPECT_NEAR(fitted.ar[1], -0.9, 0.01);
}

TEST(Noise, FitIsStationaryEvenForARamp) {
  std::vector<double> ramp(500);
  for (std::size_t k = 0; k < ramp.size(); ++k) ramp[k] = static_cast<double>(k);
  const NoiseModel fitted = FitNoise(MakeSeries(0.01, ramp), {.order = 3});
  EXPECT_TRUE(std::isfinite(SimulateNoise(fitted, 1000, Stream(1, "ramp")).back()));
  EXPECT_LT(PredictorsOf(fitted.ar).variance_ratio.front(), 1e12);
}

TEST(Noise, SimulatedVarianceIsThatOfStudentsT) {
  const NoiseModel white{.mean = 3, .scale = 2, .dof = 8};
  const std::vector<double> x = SimulateNoise(white, 100000, Stream(8, "white"));
  double mean = 0, variance = 0;
  for (const double v : x) mean += v / 1e5;
  for (const double v : x) variance += (v - mean) * (v - mean) / 1e5;
  // Variance 4 * 8 / 6; kurtosis of t(8) is 4.5, so that its relative standard error is
  // sqrt(3.5 / n) = 0.6 %.
  EXPECT_NEAR(mean, 3, 5 * std::sqrt(5.33 / 1e5));
  EXPECT_NEAR(variance, 16.0 / 3, 0.03 * 16 / 3);
}

TEST(Whitening, LikelihoodOfASegmentIsThatOfTheMultivariateNormal) {
  const NoiseModel noise{.mean = 0.5, .ar = {0.5, 0.3}, .scale = 0.7, .dof = 1e7};
  const std::vector<double> x = {1.1, -0.4, 0.8, 0.9};
  // Autocorrelations by Yule and Walker: r1 = 0.5 / 0.7, r2 = 0.5 r1 + 0.3, ..
  double r[4] = {1, 0.5 / 0.7};
  for (int k = 2; k < 4; ++k) r[k] = 0.5 * r[k - 1] + 0.3 * r[k - 2];
  const double variance = 0.49 / (1 - 0.5 * r[1] - 0.3 * r[2]);
  Eigen::Matrix4d covariance;
  Eigen::Vector4d away;
  for (int i = 0; i < 4; ++i) {
    away[i] = x[static_cast<std::size_t>(i)] - 0.5;
    for (int j = 0; j < 4; ++j) covariance(i, j) = variance * r[std::abs(i - j)];
  }
  const double expected = -0.5 * away.dot(covariance.inverse() * away) -
                          0.5 * std::log(covariance.determinant()) - 2 * std::log(2 * kPi);
  EXPECT_NEAR(Whiten(noise, MakeSeries(0.01, x)).log_likelihood, expected, 1e-5);
}

TEST(Whitening, InnovationsAfterAGapAreFlaggedAndOfUnitVariance) {
  NoiseModel noise{.ar = {1.6, -0.9}, .scale = 0.3, .dof = 200};
  Series series = NoiseSeries(noise, 60000, Stream(9, "noise"));
  for (std::size_t k = 0; k < series.size(); k += 20) series.valid[k] = 0;
  const Innovations innovations = Whiten(noise, series);
  EXPECT_EQ(innovations.count, 57000u);
  double energy[2] = {0, 0}, count[2] = {0, 0};
  for (std::size_t k = 0; k < series.size(); ++k) {
    if (!series.valid[k]) continue;
    EXPECT_EQ(innovations.restarted[k], k % 20 == 1 || k % 20 == 2);
    energy[innovations.restarted[k]] += std::pow(innovations.scaled.value[k], 2);
    ++count[innovations.restarted[k]];
  }
  EXPECT_EQ(count[1], 6000);
  EXPECT_NEAR(energy[0] / count[0], 200.0 / 198, 5 * std::sqrt(2.0 / count[0]));
  EXPECT_NEAR(energy[1] / count[1], 200.0 / 198, 5 * std::sqrt(2.0 / count[1]));
  EXPECT_EQ(CountValid(innovations.Steady().valid), 51000u);
}

TEST(Whitening, TransposedFilterIsTheAdjoint) {
  const Stream stream(2, "adjoint");
  Series series = NoiseSeries(kResonant, 300, stream);
  series.valid[40] = series.valid[41] = series.valid[200] = 0;
  const WhiteningFilter filter(kResonant, series.valid);
  EXPECT_EQ(filter.row_count(), 300u - 3 - 2 - 2 - 2);
  Eigen::VectorXd x(300), e(300);
  for (Eigen::Index k = 0; k < 300; ++k) {
    x[k] = stream.Gaussian(static_cast<std::uint64_t>(k), 5);
    e[k] = stream.Gaussian(static_cast<std::uint64_t>(k), 6);
  }
  for (Eigen::Index k = 0; k < 300; ++k) {
    if (!filter.rows()[static_cast<std::size_t>(k)]) e[k] = 0;
  }
  EXPECT_NEAR(filter.Apply(x).dot(e), x.dot(filter.Transposed(e)), 1e-10);
}

}  // namespace
}  // namespace tera
