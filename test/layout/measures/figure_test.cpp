#include "layout/measures/figure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace tera {
namespace {

TEST(FigureId, IsReadFromTheNameThatFilesHave) {
  for (const FigureId& id : std::vector<FigureId>{{Measure::kSeenBy3, "around"},
                                                  {Measure::kBlindAreaNear, "0.9"},
                                                  {Measure::kDetectedOver, "standing", 3},
                                                  {Measure::kProbability, "lying"},
                                                  {Measure::kProbabilityOfQuarter, "lying", 0},
                                                  {Measure::kProbabilityMap, "lying"},
                                                  {Measure::kPersonCurve, "lying"},
                                                  {Measure::kElevationGaps},
                                                  {Measure::kPixelMap, "1.5"},
                                                  {Measure::kPixelCurve, "detect"},
                                                  {Measure::kSkyHiddenBySite, "roof"},
                                                  {Measure::kLengthSigma, "slide"}}) {
    EXPECT_EQ(FigureIdOf(NameOf(id)), id) << NameOf(id);
  }
  EXPECT_EQ(NameOf({Measure::kDetectedFrom, "standing", 2}),
            "person/standing/detected_from_m_behind");
  EXPECT_EQ(NameOf({Measure::kSeenMap, "0.9"}), "seen/0.9 m");
  for (const char* none : {"", "zone", "zone//seen_by_1", "zone/a/seen_by_4", "elevation/gap"}) {
    EXPECT_FALSE(FigureIdOf(none)) << none;
  }
}

TEST(Figure, TheWorstIsTheLeastOrTheMost) {
  Figure figure{.id = {Measure::kSeenBy1, "a"}, .at = {0.5, 0.2, 0.8}, .error = {0.1, 0.2, 0.3}};
  EXPECT_EQ(WorstOf(figure), 0.2);
  figure.id.measure = Measure::kBlindVolume;
  EXPECT_EQ(WorstOf(figure), 0.8);
  EXPECT_NEAR(MeanOf(figure), 0.5, 1e-12);
}

TEST(Figure, ErrorsOfTheSamePlacesDoNotAverageOut) {
  const Figure figure{
      .id = {Measure::kSeenBy1, "a"}, .at = {1, 1, 1, 1}, .error = {0.1, 0.1, 0.1, 0.1}};
  EXPECT_NEAR(ErrorOf(figure), 0.1, 1e-12);
}

TEST(EvenSigma, IsTheDeviationOfWhatLiesAnywhere) {
  // Over a width of 2, in the middles of a million equal parts.
  double squares = 0;
  for (int k = 0; k < 1000000; ++k) squares += std::pow(2 * (k + 0.5) / 1e6 - 1, 2);
  EXPECT_NEAR(EvenSigma(2), std::sqrt(squares / 1e6), 1e-9);
}

TEST(ShareError, IsTheDeviationOfACountedShare) {
  // Counted shares of 400 places, drawn 3000 times. Their deviation is known within 5 / sqrt(6000),
  // 6.5 % at 5 sigma, and smoothing adds less than 2 % at 400 places.
  std::mt19937 random(1);
  for (const double share : {0.1, 0.5, 0.8}) {
    std::binomial_distribution<int> seen(400, share);
    double squares = 0;
    for (int k = 0; k < 3000; ++k) squares += std::pow(seen(random) / 400.0 - share, 2);
    const double deviation = std::sqrt(squares / 3000);
    EXPECT_NEAR(ShareError(share, 400), deviation, 0.085 * deviation) << share;
  }
}

TEST(ShareError, OfPlacesOfUnlikeWeightsIsThatOfFewerLikeOnes) {
  // 400 places, every second one with three times the weight: (200 + 600)^2 / (200 + 1800) is 320.
  // Drawn 3000 times, as above.
  std::vector<double> weights;
  for (int i = 0; i < 400; ++i) weights.push_back(i % 2 == 0 ? 1 : 3);
  EXPECT_NEAR(LikeCount(weights), 320, 1e-9);
  EXPECT_NEAR(LikeCount(std::vector<double>(7, 2.5)), 7, 1e-9);
  EXPECT_EQ(LikeCount({}), 0);
  std::mt19937 random(1);
  std::bernoulli_distribution seen(0.3);
  double squares = 0;
  for (int k = 0; k < 3000; ++k) {
    double share = 0;
    for (const double weight : weights) share += seen(random) ? weight / 800 : 0;
    squares += std::pow(share - 0.3, 2);
  }
  const double deviation = std::sqrt(squares / 3000);
  EXPECT_NEAR(ShareError(0.3, LikeCount(weights)), deviation, 0.085 * deviation);
}

TEST(ShareError, OfNoneOrAllIsNotZero) {
  // If none of n is seen, a share of 1 / n would still give that with a probability of 1 / e.
  for (const std::size_t count : {10u, 1000u}) {
    for (const double share : {0.0, 1.0}) {
      EXPECT_GT(ShareError(share, count), 0.3 / static_cast<double>(count));
      EXPECT_LT(ShareError(share, count), 3 / static_cast<double>(count));
    }
  }
  EXPECT_TRUE(std::isfinite(ShareError(0, 0)));
}

}  // namespace
}  // namespace tera
