#include "diagnose/learned/learn.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "diagnose/learned/odd_block.h"
#include "physics/actuation/learned_rate.h"

namespace tera {
namespace {

using ::testing::Each;

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

double Ripple(double lever, double temperature) { return 0.4 * std::sin(5 * temperature) * lever; }

TEST(Learn, OfAGainThatGoesUpAndDownIsThatShareAndWhatItLeavesOfTheReplay) {
  Odd odd(24, Ripple);
  LetLearn({kLever, kTemperature}, &odd);
  const auto learned = odd.Learnt();
  ASSERT_TRUE(learned.has_value());
  EXPECT_EQ(learned->channel, 0u);
  const LearnedEffect& effect = learned->effect;
  EXPECT_EQ(effect.variable.name, "temperature");
  EXPECT_TRUE(effect.is_share);
  EXPECT_LT(RmsOfDifference(effect, [](double x) { return 0.4 * std::sin(5 * x); }), 0.04);
  EXPECT_NEAR(learned->rmse_after, kNoise, 0.02);
  EXPECT_GT(learned->rmse_before, 2 * learned->rmse_after);
}

TEST(Learn, OfADragOverTheLeverHasOddValuesOverIt) {
  Odd odd(22, [](double lever, double) { return -0.3 * lever * std::abs(lever); });
  LetLearn({kLever, kTemperature, kRate}, &odd);
  const auto learned = odd.Learnt();
  ASSERT_TRUE(learned.has_value());
  EXPECT_EQ(learned->effect.variable.name, "lever");
  EXPECT_LT(learned->rmse_after, 0.8 * learned->rmse_before);
}

TEST(Learn, OfAGainThatFallsWithTemperatureIsAShareOverIt) {
  Odd odd(21, [](double lever, double temperature) { return -0.2 * lever * temperature; });
  LetLearn({kLever, kTemperature}, &odd);
  const auto learned = odd.Learnt();
  ASSERT_TRUE(learned.has_value());
  EXPECT_EQ(learned->effect.variable.name, "temperature");
  EXPECT_TRUE(learned->effect.is_share);
  EXPECT_LT(RmsOfDifference(learned->effect, [](double x) { return -0.2 * x; }), 0.05);
}

TEST(Learn, OfTwoVariablesThatDoAsWellIsOverThatWhichTheErrorWasLocatedBy) {
  Odd odd(24, Ripple);
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
    const auto learned = odd.Learnt();
    ASSERT_TRUE(learned.has_value());
    EXPECT_EQ(learned->effect.variable.name, "temperature");
  }
}

TEST(Learn, OfAVariableThatNoSimulationKnowsIsNothing) {
  Odd odd(24, Ripple);
  LetLearn({kLever}, &odd);
  EXPECT_FALSE(odd.Learnt().has_value());
}

TEST(Learn, OfWhatIsNoJointIsNothing) {
  const Odd odd(24, Ripple);
  EXPECT_FALSE(odd.Learnt().has_value());
}

TEST(Learn, OfNoiseAloneIsNothing) {
  for (const std::uint64_t seed : {31, 32, 33}) {
    Odd odd(seed, [](double, double) { return 0.0; });
    LetLearn({kLever, kTemperature}, &odd);
    EXPECT_FALSE(odd.Learnt().has_value()) << seed;
  }
}

TEST(Learn, IsTheSameForTheSameSeed) {
  Odd odd(23, [](double, double temperature) { return 0.15 * temperature; });
  LetLearn({kLever, kTemperature}, &odd);
  const auto once = odd.Learnt(7), again = odd.Learnt(7);
  ASSERT_TRUE(once && again);
  EXPECT_EQ(once->effect.value, again->effect.value);
  EXPECT_EQ(once->effect.low, again->effect.low);
  EXPECT_LT(RmsOfDifference(once->effect, [](double x) { return 0.15 * x; }), 0.03);
}

/// Manoeuvres of equal length that are all seen by the fit.
std::vector<Manoeuvre> SeenManoeuvres(std::size_t samples) {
  std::vector<Manoeuvre> manoeuvres;
  for (std::size_t begin = 0; begin < samples; begin += 200) {
    manoeuvres.push_back({.samples = {begin, std::min(begin + 200, samples)}});
  }
  return manoeuvres;
}

TEST(FittedCurve, HasABandThatHoldsTheTruthOverABinInTen) {
  const Odd odd(24, Ripple);
  const Channel& channel = odd.block.channels[0];
  Series residual = channel.measured;
  for (std::size_t k = 0; k < residual.size(); ++k) residual.value[k] -= odd.lever[k];
  const auto curve = FitCurve(SeenManoeuvres(residual.size()), {channel.variables[1]}, residual,
                              odd.lever, Stream(1, "curve"));
  ASSERT_TRUE(curve.has_value());
  EXPECT_TRUE(curve->is_share);
  ASSERT_EQ(curve->at.size(), 64);
  double beyond = 0;
  for (Eigen::Index bin = 0; bin < curve->at.size(); ++bin) {
    const double truth = 0.4 * std::sin(5 * curve->at[bin]);
    beyond += truth < curve->low[bin] - 0.03 || truth > curve->high[bin] + 0.03 ? 1 : 0;
  }
  EXPECT_LE(beyond, 4);  // of 64, except for the smoothing's loss
}

TEST(Tabulated, SharesNeverTurnARateBackAndBandsHoldTheirValues) {
  const FittedCurve curve{"temperature",
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
  FittedCurve curve{"temperature",
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
  FittedCurve curve;
  curve.at = Eigen::VectorXd::LinSpaced(11, 0, 10);
  curve.mean = curve.low = curve.high = Eigen::VectorXd::Ones(11);
  const LearnedEffect effect = TabulatedCurve(curve, kTemperature, {4, 5, 6});
  for (std::size_t k = 0; k < 11; ++k) {
    EXPECT_EQ(effect.value[k], k >= 4 && k <= 6 ? 1 : 0) << k;
  }
}

}  // namespace
}  // namespace tera
