#include "diagnose/perception/scene/moderated_t_test.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tera {
namespace {

TEST(ModeratedTTest, OfAllItsOwnScatterIsStudentsOneSidedTest) {
  // Mean 0.7, standard error 0.1: t = 2 with two degrees of freedom, whose distribution is 1/2 + t
  // / (2 sqrt(2 + t^2)).
  const ModeratedTTest test{.limit = 0.5};
  const double spread = 0.1 * std::sqrt(3.0);
  EXPECT_NEAR(test.P({0.7 - spread, 0.7, 0.7 + spread}), 0.5 - 1 / std::sqrt(6.0), 1e-9);
  EXPECT_NEAR(test.P({0.4, 0.5, 0.6}), 0.5, 1e-9);
}

TEST(ModeratedTTest, OfAFewBlocksThatAgreeIsNotSure) {
  const std::vector<double> agree = {0.6, 0.6, 0.6};
  // Ten degrees of freedom, eight of them with a scatter of 0.1: t = 0.1 / (0.1 sqrt(0.8 / 3)).
  const ModeratedTTest moderated{.limit = 0.5, .prior_blocks = 8, .prior_scatter = 0.1};
  EXPECT_NEAR(moderated.P(agree), 0.0408, 1e-4);
  // Two degrees of freedom, t = 0.1 / 0.05.
  const ModeratedTTest floored{.limit = 0.5, .least_sigma = 0.05};
  EXPECT_NEAR(floored.P(agree), 0.5 - 1 / std::sqrt(6.0), 1e-9);
}

TEST(ModeratedTTest, ShrinksTheVarianceOfAMeanTowardsThePrior) {
  // Mean 3, sum of squares 2 with two degrees of freedom, and a prior of 4 with a scatter of 0.5.
  // The variance is (2 + 1) / (2 + 4) over three values, plus 0.2 squared.
  const ModeratedTTest test{.prior_blocks = 4, .prior_scatter = 0.5, .least_sigma = 0.2};
  const ModeratedTTest::Mean mean = test.MeanOf({2, 3, 4});
  EXPECT_NEAR(mean.mean, 3, 1e-12);
  EXPECT_NEAR(mean.sigma, std::sqrt(0.5 / 3 + 0.04), 1e-12);
  EXPECT_EQ(mean.dof, 6);
}

TEST(ModeratedTTest, OfTooFewBlocksTellsNothing) {
  const ModeratedTTest test{.limit = 0.5, .fewest_blocks = 3, .least_sigma = 0.01};
  EXPECT_EQ(test.P({0.9, 0.9}), 1);
  EXPECT_LT(test.P({0.9, 0.9, 0.9}), 0.01);
}

}  // namespace
}  // namespace tera
