#include "diagnose/sensors/judge_groups.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "sensors/sensor_mechanisms.h"

// Quadratics of segments about a known truth: information I = J' J of random rows, score I p +
// noise of covariance I. Linear measurements with unit white noise have these.

namespace tera {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using ::testing::Contains;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

constexpr double kTolerance = 0.5;

/// Groups of two numbers each, all with the same tolerance, ranges a hundred times as wide.
ParameterTable Table(int groups) {
  ParameterTable table;
  for (int g = 0; g < groups; ++g) {
    table.groups.push_back(
        {{"sensor" + std::to_string(g), &SensorMechanism("bias", EffectTarget::kImu)}, 2 * g, 2});
    for (int k = 0; k < 2; ++k) {
      SensorParameter parameter;
      parameter.name = "number" + std::to_string(k);
      parameter.tolerance = kTolerance;
      parameter.free_sigma = 100 * kTolerance;
      parameter.lower = -100 * kTolerance;
      parameter.upper = 100 * kTolerance;
      table.parameters.push_back(parameter);
    }
  }
  return table;
}

/// A segment's measurements of the parameters: `rows` random rows.
MatrixXd DrawnRows(const Stream& draw, int segment, int rows, int parameters) {
  MatrixXd J(rows, parameters);
  for (int i = 0; i < rows; ++i) {
    for (int p = 0; p < parameters; ++p) {
      J(i, p) = draw.Gaussian(static_cast<std::uint64_t>(segment) * 100000 + i * 100 + p);
    }
  }
  return J;
}

ParameterQuadratic Measured(const MatrixXd& J, const VectorXd& truth, const Stream& draw,
                            int segment) {
  VectorXd errors(J.rows());
  for (int i = 0; i < J.rows(); ++i) {
    errors[i] = draw.Gaussian(static_cast<std::uint64_t>(segment) * 1000 + i, 9);
  }
  return {J.transpose() * J, J.transpose() * (J * truth + errors)};
}

/// Segments with enough rows to determine each parameter to about 0.06.
std::vector<ParameterQuadratic> Segments(std::uint64_t seed, const VectorXd& truth,
                                         int segments = 10, int rows = 30) {
  const Stream draw(seed, "segments");
  std::vector<ParameterQuadratic> made;
  for (int s = 0; s < segments; ++s) {
    made.push_back(
        Measured(DrawnRows(draw, s, rows, static_cast<int>(truth.size())), truth, draw, s));
  }
  return made;
}

std::vector<int> NamedOf(const GroupJudgement& judged) {
  std::vector<int> groups;
  for (const NamedGroup& named : judged.named) groups.push_back(named.group);
  return groups;
}

// With alpha 0.01 each draw names something with a probability of at most 0.01. More than 9 of 200
// have a binomial probability of 3e-5.
constexpr int kDraws = 200, kMostNamed = 9;

TEST(JudgeGroups, NamesNothingOfParametersWithinTheirTolerances) {
  const ParameterTable table = Table(4);
  int named = 0;
  for (int seed = 0; seed < kDraws; ++seed) {
    const Stream draw(seed, "truth");
    VectorXd truth(8);
    for (int p = 0; p < 8; ++p) truth[p] = kTolerance * (2 * draw.Uniform(p) - 1);
    named += !JudgeGroups(table, Segments(seed, truth)).named.empty();
  }
  EXPECT_LE(named, kMostNamed);
}

TEST(JudgeGroups, NamesNothingOfParametersExactlyAtTheirTolerances) {
  const ParameterTable table = Table(4);
  int named = 0;
  for (int seed = 0; seed < kDraws; ++seed) {
    const Stream draw(seed, "truth");
    VectorXd truth(8);
    for (int p = 0; p < 8; ++p) truth[p] = draw.Uniform(p) < 0.5 ? -kTolerance : kTolerance;
    named += !JudgeGroups(table, Segments(seed, truth)).named.empty();
  }
  EXPECT_LE(named, kMostNamed);
}

// Few short segments: each determines the numbers worse than their tolerances.
TEST(JudgeGroups, NamesNothingOfFewRowsMoreOftenThanItSays) {
  const ParameterTable table = Table(4);
  int named = 0;
  for (int seed = 0; seed < kDraws; ++seed) {
    named += !JudgeGroups(table, Segments(seed, VectorXd::Zero(8), 8, 3)).named.empty();
  }
  EXPECT_LE(named, kMostNamed);
}

// Errors common to segments, as from a motion unlike the model's: scores scatter three times as
// much as the information states.
TEST(JudgeGroups, NamesNothingWhereScoresScatterMoreThanInformationSays) {
  const ParameterTable table = Table(4);
  int named = 0;
  for (int seed = 0; seed < kDraws; ++seed) {
    std::vector<ParameterQuadratic> segments = Segments(seed, VectorXd::Zero(8));
    for (ParameterQuadratic& segment : segments) segment.score *= 3;
    named += !JudgeGroups(table, segments).named.empty();
  }
  EXPECT_LE(named, kMostNamed);
}

TEST(JudgeGroups, NamesTheOneBeyondWithItsNumbers) {
  const ParameterTable table = Table(4);
  int alone = 0, within_three = 0, within_two = 0, numbers = 0;
  for (int seed = 0; seed < 100; ++seed) {
    VectorXd truth = VectorXd::Zero(8);
    truth[4] = 4 * kTolerance;
    truth[5] = -0.3 * kTolerance;
    const GroupJudgement judged = JudgeGroups(table, Segments(seed, truth));
    if (NamedOf(judged) != std::vector<int>{2}) continue;
    ++alone;
    const NamedGroup& named = judged.named[0];
    EXPECT_TRUE(named.parameters[0].is_beyond);
    EXPECT_FALSE(named.parameters[1].is_beyond);
    EXPECT_GT(named.gain, 0);
    EXPECT_LT(named.p, 0.01);
    EXPECT_THAT(named.rivals, IsEmpty());
    for (int k = 0; k < 2; ++k) {
      const double off = std::abs(named.parameters[k].value - truth[4 + k]);
      within_three += off < 3 * named.parameters[k].sigma;
      within_two += off < 2 * named.parameters[k].sigma;
      ++numbers;
      // Some 300 rows with unit variance: 1 / sqrt(300) = 0.058.
      EXPECT_GT(named.parameters[k].sigma, 0.03);
      EXPECT_LT(named.parameters[k].sigma, 0.15);
    }
  }
  EXPECT_GE(alone, 97);
  // Among 200 normal errors, 0.5 are expected beyond three sigma and 9 beyond two.
  EXPECT_GE(within_three, numbers - 4);
  EXPECT_GE(within_two, numbers - 24);
}

TEST(JudgeGroups, NamesTwoBeyondBoth) {
  const ParameterTable table = Table(5);
  int both = 0;
  for (int seed = 0; seed < 20; ++seed) {
    VectorXd truth = VectorXd::Zero(10);
    truth[0] = 4 * kTolerance;
    truth[7] = -5 * kTolerance;
    std::vector<int> named = NamedOf(JudgeGroups(table, Segments(seed, truth)));
    std::sort(named.begin(), named.end());
    both += named == std::vector<int>{0, 3};
  }
  EXPECT_GE(both, 19);
}

TEST(JudgeGroups, FindsParametersThatAreBestWithTheNamedFree) {
  const ParameterTable table = Table(4);
  VectorXd truth = VectorXd::Zero(8);
  truth[4] = 6 * kTolerance;
  const GroupJudgement judged = JudgeGroups(table, Segments(1, truth));
  ASSERT_EQ(judged.parameters.size(), 8);
  for (int p = 0; p < 8; ++p) EXPECT_NEAR(judged.parameters[p], truth[p], 0.3) << p;
}

// The data determine only the sum of the first numbers of groups 1 and 3, which is four tolerances.
TEST(JudgeGroups, SaysThatTwoWithTheSameEffectAreNotToldApart) {
  const ParameterTable table = Table(4);
  for (int seed = 0; seed < 20; ++seed) {
    const Stream draw(seed, "alike");
    VectorXd truth = VectorXd::Zero(8);
    truth[2] = 5 * kTolerance;
    std::vector<ParameterQuadratic> segments;
    for (int s = 0; s < 10; ++s) {
      MatrixXd J = DrawnRows(draw, s, 30, 8);
      J.middleCols(6, 2) = J.middleCols(2, 2);
      segments.push_back(Measured(J, truth, draw, s));
    }
    const GroupJudgement judged = JudgeGroups(table, segments);
    const std::vector<int> named = NamedOf(judged);
    if (named.empty()) {
      EXPECT_THAT(judged.not_told_apart, Contains(UnorderedElementsAre(1, 3))) << seed;
    } else {
      ASSERT_EQ(named.size(), 1u) << seed;
      EXPECT_THAT(judged.named[0].rivals, Contains(named[0] == 1 ? 3 : 1)) << seed;
      EXPECT_TRUE(named[0] == 1 || named[0] == 3) << seed;
    }
  }
}

// As for the zeros of two encoders, of a boom (group 3) and of an arm behind it (group 4), and the
// mounts of three units, one on the boom. The data determine the sum of groups 0 and 3, and those
// of 1 and of 2 with 3 and 4. Group 3 is off by 2.8 tolerances, group 0 by a little more than one.
// The hypothesis that only group 0 is off, by 2.9, fits slightly better, but needs all others to be
// off by about a tolerance, two sigma each.
TEST(JudgeGroups, NamesTheCauseForWhichNothingElseMustBeStretched) {
  const ParameterTable table = Table(5);
  int right = 0;
  for (int seed = 0; seed < 20; ++seed) {
    const Stream draw(seed, "common");
    VectorXd truth = VectorXd::Zero(10);
    truth[6] = 2.8 * kTolerance;
    truth[0] = 1.25 * kTolerance;
    std::vector<ParameterQuadratic> segments;
    for (int s = 0; s < 10; ++s) {
      MatrixXd J = MatrixXd::Zero(180, 10);
      for (int unit = 0; unit < 3; ++unit) {
        const MatrixXd rows = DrawnRows(draw, 3 * s + unit, 60, 2);
        J.block(60 * unit, 2 * unit, 60, 2) = J.block(60 * unit, 6, 60, 2) = rows;
        if (unit > 0) J.block(60 * unit, 8, 60, 2) = rows;
      }
      segments.push_back(Measured(J, truth, draw, s));
    }
    right += NamedOf(JudgeGroups(table, segments)) == std::vector<int>{3};
  }
  EXPECT_GE(right, 19);
}

// Group 1 is off by five tolerances and group 3 by as much in the opposite direction: the data show
// nothing.
TEST(JudgeGroups, NamesNeitherOfTwoThatCancelExactly) {
  const ParameterTable table = Table(4);
  int named = 0;
  for (int seed = 0; seed < kDraws; ++seed) {
    const Stream draw(seed, "cancel");
    VectorXd truth = VectorXd::Zero(8);
    truth[2] = 5 * kTolerance;
    truth[6] = -5 * kTolerance;
    std::vector<ParameterQuadratic> segments;
    for (int s = 0; s < 10; ++s) {
      MatrixXd J = DrawnRows(draw, s, 30, 8);
      J.middleCols(6, 2) = J.middleCols(2, 2);
      segments.push_back(Measured(J, truth, draw, s));
    }
    named += !JudgeGroups(table, segments).named.empty();
  }
  EXPECT_LE(named, kMostNamed);
}

TEST(JudgeGroups, OfAGroupThatNothingExcitesIsUntestable) {
  const ParameterTable table = Table(4);
  const Stream draw(1, "unexcited");
  VectorXd truth = VectorXd::Zero(8);
  truth[0] = 5 * kTolerance;
  std::vector<ParameterQuadratic> segments;
  for (int s = 0; s < 10; ++s) {
    MatrixXd J = DrawnRows(draw, s, 30, 8);
    J.middleCols(4, 2).setZero();
    segments.push_back(Measured(J, truth, draw, s));
  }
  const GroupJudgement judged = JudgeGroups(table, segments);
  EXPECT_THAT(judged.untestable, UnorderedElementsAre(2));
  EXPECT_THAT(NamedOf(judged), UnorderedElementsAre(0));
  for (const std::vector<JudgedParameter>& group : judged.by_group) {
    for (const JudgedParameter& number : group) {
      EXPECT_TRUE(std::isfinite(number.value));
      EXPECT_TRUE(std::isfinite(number.sigma));
    }
  }
}

TEST(JudgeGroups, OfNoneThatIsExcitedNamesNothing) {
  const ParameterTable table = Table(3);
  const std::vector<ParameterQuadratic> segments(
      10, ParameterQuadratic{MatrixXd::Zero(6, 6), VectorXd::Zero(6)});
  const GroupJudgement judged = JudgeGroups(table, segments);
  EXPECT_THAT(judged.named, IsEmpty());
  EXPECT_THAT(judged.untestable, UnorderedElementsAre(0, 1, 2));
}

// A single segment leaves nothing held out, hence no steady gain.
TEST(JudgeGroups, OfOneSegmentOrNoneNamesNothing) {
  VectorXd truth = VectorXd::Zero(8);
  truth[4] = 10 * kTolerance;
  EXPECT_THAT(JudgeGroups(Table(4), Segments(1, truth, 1)).named, IsEmpty());
  EXPECT_THAT(JudgeGroups(Table(4), {}).named, IsEmpty());
  JudgeGroups(Table(4), Segments(1, truth, 2));
  EXPECT_THAT(JudgeGroups(Table(0), {}).named, IsEmpty());
}

// A collision in one of ten segments suggests ten tolerances; all others suggest none.
TEST(JudgeGroups, DoesNotNameWhatASingleSegmentSays) {
  const ParameterTable table = Table(4);
  for (int seed = 0; seed < 30; ++seed) {
    std::vector<ParameterQuadratic> segments = Segments(seed, VectorXd::Zero(8));
    VectorXd outlying = VectorXd::Zero(8);
    outlying[4] = 30 * kTolerance;
    segments[3] = Segments(seed + 1000, outlying)[3];
    EXPECT_THAT(NamedOf(JudgeGroups(table, segments)), IsEmpty()) << seed;
  }
}

TEST(JudgeGroups, DoesNotCallWithinWhatIsNamedOrAsDocumented) {
  const ParameterTable table = Table(4);
  VectorXd truth = VectorXd::Zero(8);
  truth[0] = 0.9 * kTolerance;  // seven sigma from documented
  truth[4] = 4 * kTolerance;
  const GroupJudgement judged = JudgeGroups(table, Segments(5, truth));
  EXPECT_THAT(NamedOf(judged), UnorderedElementsAre(2));
  EXPECT_THAT(judged.within, UnorderedElementsAre(0));
}

// The same in a thousandth of the unit, with a million times the information.
TEST(JudgeGroups, IsTheSameInAnotherUnit) {
  VectorXd truth = VectorXd::Zero(8);
  truth[4] = 4 * kTolerance;
  const std::vector<ParameterQuadratic> segments = Segments(6, truth);
  for (const double unit : {1e-3, 1e3}) {
    ParameterTable table = Table(4);
    VectorXd scale = VectorXd::Ones(8);
    for (const int p : {2, 3, 4, 5}) scale[p] = unit;
    std::vector<ParameterQuadratic> scaled;
    for (const ParameterQuadratic& segment : segments) {
      scaled.push_back({scale.asDiagonal() * segment.information * scale.asDiagonal(),
                        scale.cwiseProduct(segment.score)});
    }
    for (int p = 0; p < 8; ++p) {
      table.parameters[p].tolerance /= scale[p];
      table.parameters[p].free_sigma /= scale[p];
      table.parameters[p].lower /= scale[p];
      table.parameters[p].upper /= scale[p];
    }
    const GroupJudgement one = JudgeGroups(Table(4), segments), other = JudgeGroups(table, scaled);
    ASSERT_THAT(NamedOf(other), UnorderedElementsAre(2)) << unit;
    EXPECT_NEAR(other.named[0].parameters[0].value * unit, one.named[0].parameters[0].value, 1e-3);
    EXPECT_NEAR(other.named[0].parameters[0].sigma * unit, one.named[0].parameters[0].sigma, 1e-3);
    EXPECT_NEAR(other.named[0].gain, one.named[0].gain, 1e-3 * one.named[0].gain);
  }
}

TEST(JudgeGroups, NamesNoMoreThanItIsAllowedTo) {
  VectorXd truth = VectorXd::Zero(12);
  for (int g = 0; g < 6; ++g) truth[2 * g] = (4 + g) * kTolerance;
  JudgeOptions options;
  options.most_named = 2;
  EXPECT_LE(JudgeGroups(Table(6), Segments(7, truth), options).named.size(), 2u);
}

}  // namespace
}  // namespace tera
