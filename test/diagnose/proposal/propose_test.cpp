#include "diagnose/proposal/propose.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "diagnose/proposal/odd_block.h"
#include "diagnose/report/text/proposal_text.h"

namespace tera {
namespace {

using ::testing::HasSubstr;

TEST(Proposal, OfAGainThatFallsWithTemperatureIsThatProduct) {
  // Oil thins: the response to the lever falls in proportion to the temperature.
  const Odd odd(21, [](double lever, double temperature) { return -0.2 * lever * temperature; });
  const auto proposal = odd.Proposed();
  ASSERT_TRUE(proposal.has_value());
  ASSERT_EQ(proposal->terms.size(), 1u);
  const ProposedTerm& term = proposal->terms[0];
  EXPECT_NEAR(term.coefficient, -0.2, 3 * term.sigma);
  EXPECT_LT(term.sigma, 0.02);
  EXPECT_GE(term.stability, 0.7);
  // The toy's rate is its lever: either may be in the product.
  const std::string text = TermText(odd.block, term.factors);
  EXPECT_THAT(text, HasSubstr("temperature"));
  EXPECT_EQ(term.factors.size(), 2u);
  EXPECT_NEAR(proposal->rmse_after, kNoise, 0.02);
  EXPECT_GT(proposal->rmse_before, 1.5 * proposal->rmse_after);
  EXPECT_THAT(
      SentenceOf(odd.block, *proposal),
      AllOf(HasSubstr("a proposal and no name: add -0.199 ± 0.011"), HasSubstr("temperature")));
}

TEST(Proposal, OfADragThatGrowsWithTheSquareHasTheSquareThatKeepsItsSign) {
  const Odd odd(22, [](double lever, double) { return -0.3 * lever * std::abs(lever); });
  const auto proposal = odd.Proposed();
  ASSERT_TRUE(proposal.has_value());
  EXPECT_EQ(proposal->terms[0].factors[0].form, FactorForm::kSignedSquare);
  EXPECT_NEAR(proposal->terms[0].coefficient, -0.3, 0.06);
}

TEST(Proposal, OfAGainThatGoesUpAndDownIsItsCurve) {
  const Odd odd(
      24, [](double lever, double temperature) { return 0.4 * std::sin(5 * temperature) * lever; });
  const auto proposal = odd.Proposed();
  ASSERT_TRUE(proposal.has_value());
  EXPECT_TRUE(proposal->terms.empty());
  ASSERT_TRUE(proposal->curve.has_value());
  const ProposedCurve& curve = *proposal->curve;
  EXPECT_EQ(curve.variable, "temperature");
  EXPECT_TRUE(curve.is_share);
  ASSERT_EQ(curve.at.size(), 64);
  double square = 0, beyond = 0;
  for (Eigen::Index bin = 0; bin < curve.at.size(); ++bin) {
    const double truth = 0.4 * std::sin(5 * curve.at[bin]);
    square += std::pow(curve.mean[bin] - truth, 2);
    beyond += truth < curve.low[bin] - 0.03 || truth > curve.high[bin] + 0.03 ? 1 : 0;
  }
  EXPECT_LT(std::sqrt(square / 64), 0.04);  // of 0.28
  EXPECT_LE(beyond, 4);                     // of 64, except for the smoothing's loss
  EXPECT_NEAR(proposal->rmse_after, kNoise, 0.02);
  EXPECT_GT(proposal->rmse_before, 2 * proposal->rmse_after);
  EXPECT_THAT(SentenceOf(odd.block, *proposal),
              AllOf(HasSubstr("a curve for what is left, a proposal and no name: add rate · "
                              "c(temperature), c from -0."),
                    HasSubstr(" at ")));
}

TEST(Proposal, OfNoiseAloneIsNone) {
  for (const std::uint64_t seed : {31, 32, 33}) {
    const Odd odd(seed, [](double, double) { return 0.0; });
    EXPECT_FALSE(odd.Proposed().has_value()) << seed;
  }
}

TEST(Proposal, IsTheSameForTheSameSeed) {
  const Odd odd(23, [](double, double temperature) { return 0.15 * temperature; });
  const auto once = odd.Proposed(7), again = odd.Proposed(7);
  ASSERT_TRUE(once && again);
  EXPECT_EQ(once->terms[0].coefficient, again->terms[0].coefficient);
  EXPECT_EQ(once->terms[0].stability, again->terms[0].stability);
  EXPECT_NEAR(once->terms[0].coefficient, 0.15, 0.02);
}

TEST(Proposal, WritesTheUnitThatMakesATermOneOfTheChannel) {
  ReplayBlock block;
  block.name = "boom";
  block.channels = {{"excavator1/encoders/boom_radps", "rad/s", {}, {}, {}, {}, {}}};
  const std::vector<Factor> gravity = {{"load/boom", FactorForm::kValue}};
  EXPECT_EQ(CoefficientUnit(block, 0, gravity), "rad/s/(N m)");
  EXPECT_EQ(CoefficientUnit(block, 0, {{"rate"}, {"lever/arm", FactorForm::kMagnitude}}), "1");
  EXPECT_EQ(TermText(block, {{"rate"}, {"lever/arm", FactorForm::kMagnitude}}),
            "rate · |arm lever|");
  EXPECT_EQ(CoefficientUnit(block, 0, {{"position/boom", FactorForm::kCosine}}), "rad/s");
}

}  // namespace
}  // namespace tera
