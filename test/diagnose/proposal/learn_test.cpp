#include "diagnose/proposal/learn.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "diagnose/proposal/odd_block.h"
#include "physics/actuation/learned_rate.h"

namespace tera {
namespace {

using ::testing::Each;
using ::testing::HasSubstr;

const LearnedVariable kTemperature{"temperature", "1", LearnedVariable::Kind::kPosition, 0};
const LearnedVariable kLever{"lever", "1", LearnedVariable::Kind::kLever, 0};
const LearnedVariable kRate{"rate", "1", LearnedVariable::Kind::kRate, 0};

/// Allows learned effects of some variables in the toy; a joint's position stands for temperature.
void LetLearn(const std::vector<LearnedVariable>& variables, Odd* odd) {
  odd->block.learnable = variables;
  const ReplayBlock* block = &odd->block;
  odd->block.change_by_learned = [block](const Structure& terms, const LearnedEffect& effect) {
    const std::vector<RegimeVariable>& own = block->channels[0].variables;
    LearnedRate learned(effect);
    std::vector<double> change = block->predict(terms)[0];
    for (std::size_t k = 0; k < change.size(); ++k) {
      change[k] = learned.Step(change[k], {.lever = own[0].series.value[k],
                                           .position_rad = own[1].series.value[k]}) -
                  change[k];
    }
    return std::vector<std::vector<double>>{change};
  };
}

double RmsOfDifference(const LearnedEffect& effect, const std::function<double(double)>& truth) {
  double square = 0;
  for (std::size_t k = 0; k < effect.at.size(); ++k) {
    square += std::pow(effect.value[k] - truth(effect.at[k]), 2);
  }
  return std::sqrt(square / static_cast<double>(effect.at.size()));
}

TEST(Learn, OfACurveIsThatCurveAsAnEffectAndWhatItLeavesOfTheReplay) {
  Odd odd(24,
          [](double lever, double temperature) { return 0.4 * std::sin(5 * temperature) * lever; });
  LetLearn({kLever, kTemperature}, &odd);
  const auto proposal = odd.Proposed();
  ASSERT_TRUE(proposal.has_value());
  ASSERT_TRUE(proposal->learned.has_value()) << proposal->not_learned;
  const LearnedEffect& effect = proposal->learned->effect;
  EXPECT_EQ(effect.variable.name, "temperature");
  EXPECT_TRUE(effect.is_share);
  EXPECT_LT(RmsOfDifference(effect, [](double x) { return 0.4 * std::sin(5 * x); }), 0.04);
  EXPECT_NEAR(proposal->learned->rmse_after, kNoise, 0.02);
  EXPECT_GT(proposal->learned->rmse_before, 2 * proposal->learned->rmse_after);
  EXPECT_EQ(proposal->not_learned, "");
}

TEST(Learn, OfAFormulaOfOneVariableIsItsTable) {
  Odd odd(22, [](double lever, double) { return -0.3 * lever * std::abs(lever); });
  LetLearn({kLever, kTemperature, kRate}, &odd);
  const auto proposal = odd.Proposed();
  ASSERT_TRUE(proposal.has_value());
  ASSERT_EQ(proposal->terms.size(), 1u);
  ASSERT_TRUE(proposal->learned.has_value()) << proposal->not_learned;
  const LearnedEffect& effect = proposal->learned->effect;
  EXPECT_EQ(effect.variable.name, proposal->terms[0].factors[0].variable);
  EXPECT_FALSE(effect.is_share);
  const double a = proposal->terms[0].coefficient;
  EXPECT_LT(RmsOfDifference(effect, [&](double x) { return a * x * std::abs(x); }), 1e-12);
  EXPECT_LT(proposal->learned->rmse_after, 0.8 * proposal->learned->rmse_before);
}

TEST(Learn, OfAProductWithTheRateIsAShareOverTheOtherFactor) {
  Odd odd(21, [](double lever, double temperature) { return -0.2 * lever * temperature; });
  LetLearn({kLever, kTemperature}, &odd);
  const auto proposal = odd.Proposed();
  ASSERT_TRUE(proposal.has_value());
  ASSERT_TRUE(proposal->learned.has_value()) << proposal->not_learned;
  EXPECT_EQ(proposal->learned->effect.variable.name, "temperature");
  EXPECT_TRUE(proposal->learned->effect.is_share);
  EXPECT_LT(RmsOfDifference(proposal->learned->effect, [](double x) { return -0.2 * x; }), 0.03);
}

TEST(Learn, OfTwoVariablesThatDoAsWellIsOverThatWhichTheErrorWasLocatedBy) {
  Odd odd(24,
          [](double lever, double temperature) { return 0.4 * std::sin(5 * temperature) * lever; });
  LearnedVariable load = kTemperature;
  load.name = "load";
  LetLearn({load, kTemperature}, &odd);
  std::vector<RegimeVariable>& variables = odd.block.channels[0].variables;
  variables.push_back(variables[1]);
  odd.diagnosis.unexplained.resize(1);
  odd.diagnosis.unexplained[0].location.regimes.resize(1);
  odd.diagnosis.unexplained[0].location.regimes[0].variable = "temperature";
  for (const auto& [twin, located] : {std::pair(1, 2), {2, 1}}) {
    variables[static_cast<std::size_t>(twin)].name = "load";
    variables[static_cast<std::size_t>(located)].name = "temperature";
    const auto proposal = odd.Proposed();
    ASSERT_TRUE(proposal.has_value());
    ASSERT_TRUE(proposal->learned.has_value()) << proposal->not_learned;
    EXPECT_EQ(proposal->learned->effect.variable.name, "temperature");
  }
}

TEST(Learn, OfAVariableThatNoSimulationKnowsIsNothing) {
  Odd odd(24,
          [](double lever, double temperature) { return 0.4 * std::sin(5 * temperature) * lever; });
  LetLearn({kLever}, &odd);
  const auto proposal = odd.Proposed();
  ASSERT_TRUE(proposal.has_value());
  EXPECT_FALSE(proposal->learned.has_value());
  EXPECT_THAT(proposal->not_learned, HasSubstr("no function of one variable that a simulation"));
}

TEST(Learn, OfWhatIsNoJointIsNothing) {
  const Odd odd(
      24, [](double lever, double temperature) { return 0.4 * std::sin(5 * temperature) * lever; });
  const auto proposal = odd.Proposed();
  ASSERT_TRUE(proposal.has_value());
  EXPECT_FALSE(proposal->learned.has_value());
  EXPECT_THAT(proposal->not_learned, HasSubstr("joints, tracks and wheel sets alone"));
}

TEST(Tabulated, SharesNeverTurnARateBackAndBandsHoldTheirValues) {
  const ProposedCurve curve{"temperature",
                            true,
                            Eigen::Vector3d(0, 1, 2),
                            Eigen::Vector3d(-1.5, 0.2, 12),
                            Eigen::Vector3d(-2, 0.3, 11),
                            Eigen::Vector3d(-1.2, 0.4, 13)};
  const LearnedEffect effect = TabulatedCurve(curve, kTemperature, {0, 0.5, 1, 1.5, 2});
  EXPECT_EQ(effect.value, (std::vector<double>{-1, 0.2, 9}));
  EXPECT_EQ(effect.low, (std::vector<double>{-1, 0.2, 9}));
  EXPECT_EQ(effect.high, (std::vector<double>{-1, 0.4, 9}));
}

TEST(Tabulated, IsZeroWhereNothingWasSeen) {
  ProposedCurve curve{"temperature",
                      false,
                      Eigen::VectorXd::LinSpaced(11, 0, 10),
                      Eigen::VectorXd::Constant(11, 0.5),
                      {},
                      {}};
  curve.low = curve.high = curve.mean;
  std::vector<double> seen;
  for (double x = 0; x <= 10; x += 0.25) {
    if (x <= 4 || x >= 8) seen.push_back(x);  // a gap of 4 in 10
  }
  const LearnedEffect gap = TabulatedCurve(curve, kTemperature, seen);
  EXPECT_EQ(gap.value, (std::vector<double>{.5, .5, .5, .5, .5, 0, 0, 0, .5, .5, .5}));
  EXPECT_EQ(gap.At(4.5), 0.25);
  // A ladder of levers has smaller ones, for which the curve is trusted.
  const LearnedEffect ladder = TabulatedCurve(curve, kTemperature, {0, 2, 4, 6, 8, 10});
  EXPECT_THAT(ladder.value, Each(0.5));
}

// Observed only from 4 to 6 of 10: beyond a quarter of the range, values are invented.
TEST(Tabulated, IsZeroAtEndsThatNothingWasSeenOf) {
  ProposedCurve curve;
  curve.at = Eigen::VectorXd::LinSpaced(11, 0, 10);
  curve.mean = curve.low = curve.high = Eigen::VectorXd::Ones(11);
  const LearnedEffect effect = TabulatedCurve(curve, kTemperature, {4, 5, 6});
  for (std::size_t k = 0; k < 11; ++k) {
    EXPECT_EQ(effect.value[k], k >= 4 && k <= 6 ? 1 : 0) << k;
  }
}

TEST(Tabulated, OfAFormulaOfTwoVariablesIsNone) {
  const Odd odd(24, [](double, double) { return 0.0; });
  const Channel& channel = odd.block.channels[0];
  const std::vector<double> predicted = odd.block.predict({})[0];
  const ProposedTerm of_both{{{"lever"}, {"temperature"}}, 1, 0.1, 1};
  EXPECT_FALSE(TabulatedFormula(channel, predicted, {of_both}).has_value());
  const ProposedTerm share{{{"rate"}, {"lever", FactorForm::kMagnitude}}, -0.5, 0.1, 1};
  const ProposedTerm added{{{"lever"}}, 1, 0.1, 1};
  EXPECT_FALSE(TabulatedFormula(channel, predicted, {share, added}).has_value());
  const auto curve = TabulatedFormula(channel, predicted, {share});
  ASSERT_TRUE(curve.has_value());
  EXPECT_EQ(curve->variable, "lever");
  EXPECT_TRUE(curve->is_share);
  for (Eigen::Index b = 0; b < curve->at.size(); ++b) {
    const double x = std::abs(curve->at[b]);
    EXPECT_NEAR(curve->mean[b], -0.5 * x, 1e-12);
    EXPECT_NEAR(curve->high[b] - curve->low[b], 2 * 1.645 * 0.1 * x, 1e-12);
  }
}

}  // namespace
}  // namespace tera
