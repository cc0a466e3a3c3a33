#include "diagnose/motion/residual_noise.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"

namespace tera {
namespace {

/// Student's t with five degrees of freedom: a normal over the root of the mean of five squares.
double DrawT(const Stream& draw, std::uint64_t index) {
  double squares = 0;
  for (int k = 1; k <= 5; ++k) squares += std::pow(draw.Gaussian(index, k), 2);
  return draw.Gaussian(index) / std::sqrt(squares / 5);
}

std::vector<double> WhiteT(int count, double scale, std::uint64_t seed) {
  const Stream draw(seed, "white");
  std::vector<double> residuals;
  for (int k = 0; k < count; ++k) residuals.push_back(scale * DrawT(draw, k));
  return residuals;
}

NoiseChannel Estimated(std::vector<std::vector<double>> by_segment, double least = 0) {
  std::vector<NoiseChannel> noise(1);
  noise[0].least = least;
  EstimateNoise({{std::move(by_segment)}}, &noise);
  return noise[0];
}

TEST(ErrorWeight, FallsAsStudentsTWithFiveDegreesOfFreedomHasIt) {
  // (nu + 1) / (nu + (r / sigma)^2): 6/5 at zero, 1 at one sigma, 6/30 at five.
  const double at_none = ErrorWeight(0, 0.3);
  EXPECT_GT(at_none, 0);
  for (const double r : {-2.0, -0.1, 0.3, 1.5, 30.0}) {
    EXPECT_NEAR(ErrorWeight(r, 0.3) / at_none, 5 / (5 + r * r / 0.09), 1e-12) << r;
  }
}

// The expected information of log sigma is 2 nu / (nu + 3) = 1.25 for each error (Lange, Little and
// Taylor 1989). From 20000 errors, its standard error is 1 / sqrt(25000) = 0.0063.
TEST(EstimateNoise, FindsTheScaleOfStudentsErrors) {
  for (const double scale : {1e-4, 0.3, 50.0}) {
    const NoiseChannel noise = Estimated({WhiteT(20000, scale, 1)});
    EXPECT_NEAR(std::log(noise.sigma / scale), 0, 5 * 0.0063) << scale;
    EXPECT_GE(noise.inflation, 1);
    // One autocorrelation of 20000 errors has a standard error of 0.007, below the limit of 0.05.
    EXPECT_LT(noise.inflation, 1.1);
  }
}

// A constant that is not yet explained is no noise: its errors correlate indefinitely.
TEST(EstimateNoise, LeavesOutWhatAllResidualsAreOffByAlike) {
  std::vector<double> off = WhiteT(20000, 0.05, 3);
  for (double& one : off) one += 0.4;
  const NoiseChannel noise = Estimated({off});
  EXPECT_NEAR(std::log(noise.sigma / 0.05), 0, 5 * 0.0063);
  EXPECT_LT(noise.inflation, 1.1);
}

// The variance of a mean of AR(1) errors with coefficient rho is (1 + rho) / (1 - rho) times that
// of independent errors. Correlations above 0.05 are summed: for rho = 0.6 over five lags, 1 + 2 *
// 1.383 = 3.77. Weights reduce it slightly.
TEST(EstimateNoise, FindsHowMuchErrorsThatFollowEachOtherInflateAMean) {
  const Stream draw(2, "steps");
  std::vector<double> residuals = {draw.Gaussian(0)};
  for (int k = 1; k < 40000; ++k) {
    residuals.push_back(0.6 * residuals.back() + 0.8 * draw.Gaussian(k));
  }
  const NoiseChannel noise = Estimated({residuals});
  EXPECT_GT(noise.inflation, 3);
  EXPECT_LT(noise.inflation, 4.2);
}

TEST(EstimateNoise, DoesNotTakeTheEndOfASegmentForTheBeginningOfTheNext) {
  // Alternating signs of one-sample segments would have an autocorrelation of -1 across them.
  std::vector<std::vector<double>> segments;
  const std::vector<double> white = WhiteT(4000, 1, 3);
  for (const double r : white) segments.push_back({r});
  const NoiseChannel noise = Estimated(segments);
  EXPECT_NEAR(noise.inflation, 1, 1e-12) << "no two residuals are of one segment";
  EXPECT_NEAR(std::log(noise.sigma), 0, 5 / std::sqrt(1.25 * 4000));
}

TEST(EstimateNoise, IsNotBelowTheDataSheet) {
  EXPECT_GE(Estimated({WhiteT(500, 0.01, 4)}, 0.05).sigma, 0.05);
  EXPECT_GE(Estimated({std::vector<double>(500, 0.0)}, 0.05).sigma, 0.05);
}

TEST(EstimateNoise, OfAFewLargeErrorsIsThatOfTheOthers) {
  std::vector<double> residuals = WhiteT(5000, 0.1, 5);
  for (int k = 0; k < 5000; k += 100) residuals[k] = 100;
  const NoiseChannel noise = Estimated({residuals});
  EXPECT_GT(noise.sigma, 0.09);
  EXPECT_LT(noise.sigma, 0.13) << "one in a hundred is a thousand times as large";
}

TEST(EstimateNoise, OfNothingOneOrNoughtsIsFinite) {
  const std::vector<std::vector<double>> cases[] = {
      {}, {{}}, {{}, {}}, {{0.3}}, {std::vector<double>(100, 0.0)}, {{1, 1, 1, 1}}, {{1e-200, 0}}};
  for (const auto& by_segment : cases) {
    const NoiseChannel noise = Estimated(by_segment);
    EXPECT_TRUE(std::isfinite(noise.sigma));
    EXPECT_GT(noise.sigma, 0);
    EXPECT_TRUE(std::isfinite(noise.inflation));
    EXPECT_GE(noise.inflation, 1);
  }
}

}  // namespace
}  // namespace tera
