#include "diagnose/motion/bounded_quadratic.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>
#include <vector>

#include "core/random.h"

// The minimum of a convex quadratic in a box fixes some numbers at bounds and minimises freely over
// the others. The reference tries all 3^n choices.

namespace tera {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double At(const MatrixXd& A, const VectorXd& b, const VectorXd& x) {
  return 0.5 * x.dot(A * x) - b.dot(x);
}

VectorXd ByAllActiveSets(const MatrixXd& A, const VectorXd& b, const VectorXd& lower,
                         const VectorXd& upper) {
  const int n = static_cast<int>(b.size());
  int choices = 1;
  for (int i = 0; i < n; ++i) choices *= 3;
  VectorXd best;
  double least = kInfinity;
  for (int choice = 0; choice < choices; ++choice) {
    VectorXd x = VectorXd::Zero(n);
    std::vector<int> free;
    bool possible = true;
    for (int i = 0, rest = choice; i < n; ++i, rest /= 3) {
      if (rest % 3 == 0) {
        free.push_back(i);
      } else {
        x[i] = rest % 3 == 1 ? lower[i] : upper[i];
        possible &= std::isfinite(x[i]);
      }
    }
    if (!possible) continue;
    if (!free.empty()) {
      const MatrixXd Aff = A(free, free);
      const VectorXd right = (b - A * x)(free);
      const VectorXd best_free = Aff.llt().solve(right);
      x(free) = best_free;
    }
    const double slack = 1e-12;
    if (((x - lower).array() < -slack).any() || ((upper - x).array() < -slack).any()) continue;
    if (At(A, b, x) < least) {
      least = At(A, b, x);
      best = x;
    }
  }
  return best;
}

/// A A' + I of random numbers, the rows and columns scaled.
MatrixXd RandomPositive(const Stream& draw, std::uint64_t seed, const VectorXd& scale) {
  const int n = static_cast<int>(scale.size());
  MatrixXd root(n, n);
  for (int i = 0; i < n * n; ++i) root(i / n, i % n) = draw.Gaussian(seed * 100 + i);
  const MatrixXd A = root * root.transpose() + 0.1 * MatrixXd::Identity(n, n);
  return scale.asDiagonal() * A * scale.asDiagonal();
}

struct Drawn {
  MatrixXd A;
  VectorXd b, lower, upper, scale;
};

/// Two to four numbers whose units differ by up to 10^(2 decades), with a third of the bounds
/// infinite.
Drawn Draw(std::uint64_t seed, double decades) {
  const Stream draw(seed, "quadratic");
  const int n = 2 + static_cast<int>(seed % 3);
  Drawn made;
  made.scale = made.b = made.lower = made.upper = VectorXd::Zero(n);
  for (int i = 0; i < n; ++i) {
    made.scale[i] = std::pow(10.0, decades * (2 * draw.Uniform(i, 1) - 1));
    made.b[i] = 3 * draw.Gaussian(i, 2) * made.scale[i];
    const double middle = draw.Gaussian(i, 3), half = 0.02 + draw.Uniform(i, 4);
    made.lower[i] = draw.Uniform(i, 5) < 0.33 ? -kInfinity : (middle - half) / made.scale[i];
    made.upper[i] = draw.Uniform(i, 6) < 0.33 ? kInfinity : (middle + half) / made.scale[i];
  }
  made.A = RandomPositive(draw, 7, made.scale);
  return made;
}

void ExpectLeast(const Drawn& made, double tolerance, std::uint64_t seed) {
  const VectorXd expected = ByAllActiveSets(made.A, made.b, made.lower, made.upper);
  const VectorXd found = SmallestWithin(made.A, made.b, made.lower, made.upper);
  ASSERT_EQ(found.size(), expected.size());
  ASSERT_TRUE(found.allFinite()) << seed;
  for (int i = 0; i < found.size(); ++i) {
    EXPECT_GE(found[i], made.lower[i] - 1e-9 / made.scale[i]) << seed;
    EXPECT_LE(found[i], made.upper[i] + 1e-9 / made.scale[i]) << seed;
  }
  EXPECT_LT((found - expected).cwiseProduct(made.scale).cwiseAbs().maxCoeff(), tolerance)
      << "seed " << seed << ": " << found.transpose() << " instead of " << expected.transpose();
}

TEST(SmallestWithin, IsTheLeastOfAllActiveSets) {
  for (std::uint64_t seed = 0; seed < 400; ++seed) ExpectLeast(Draw(seed, 0), 1e-5, seed);
}

TEST(SmallestWithin, IsTheLeastWhereUnitsDifferByManyDecades) {
  for (std::uint64_t seed = 0; seed < 400; ++seed) ExpectLeast(Draw(seed, 4), 1e-5, seed);
}

// 1e8 times the quadratic: as much information as a long recording has.
TEST(SmallestWithin, IsTheLeastOfLargeValues) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Drawn made = Draw(seed, 0);
    made.A *= 1e8;
    made.b *= 1e8;
    ExpectLeast(made, 1e-5, seed);
  }
}

TEST(SmallestWithin, WithoutBoundsSolvesTheEquations) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Drawn made = Draw(seed, 2);
    made.lower.setConstant(-kInfinity);
    made.upper.setConstant(kInfinity);
    const VectorXd expected = made.A.llt().solve(made.b);
    const VectorXd found = SmallestWithin(made.A, made.b, made.lower, made.upper);
    EXPECT_LT((found - expected).cwiseProduct(made.scale).norm(), 1e-8) << seed;
  }
}

TEST(SmallestWithin, FindsWhatLiesExactlyAtABound) {
  const VectorXd x = VectorXd::LinSpaced(3, -1, 2);
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Drawn made;
    made.scale = VectorXd::Ones(3);
    made.A = RandomPositive(Stream(seed, "at a bound"), 0, made.scale);
    made.b = made.A * x;  // nothing pushes against the bounds
    made.lower = x;
    made.upper = x.array() + 1;
    made.upper[1] = kInfinity;
    // Without a gradient, the error of an interior point is the root of its precision.
    const VectorXd found = SmallestWithin(made.A, made.b, made.lower, made.upper);
    EXPECT_LT((found - x).cwiseAbs().maxCoeff(), 1e-4) << seed << ": " << found.transpose();
  }
}

TEST(SmallestWithin, FindsTheWayThroughBoundsThatNearlyMeet) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Drawn made = Draw(seed, 0);
    made.lower[0] = 0.3;
    made.upper[0] = 0.3 + 1e-9;
    ExpectLeast(made, 1e-5, seed);
  }
}

TEST(SmallestWithin, StaysAtABoundThatIsTheOnlyPlace) {
  Drawn made = Draw(5, 0);
  made.lower[0] = made.upper[0] = 0.3;
  const VectorXd found = SmallestWithin(made.A, made.b, made.lower, made.upper);
  ASSERT_TRUE(found.allFinite()) << found.transpose();
  EXPECT_NEAR(found[0], 0.3, 1e-6);
}

TEST(SmallestWithin, FindsALeastThatIsFarBeyondABound) {
  for (const double far : {1e3, 1e6, 1e9}) {
    Drawn made;
    made.scale = VectorXd::Ones(2);
    made.A.resize(2, 2);
    made.A << 2, 1, 1, 3;
    made.b = Eigen::Vector2d(far, 0);
    made.lower = Eigen::Vector2d(-1, -kInfinity);
    made.upper = Eigen::Vector2d(1, kInfinity);
    // x = 1 at its bound, then 3 y = -1.
    const VectorXd found = SmallestWithin(made.A, made.b, made.lower, made.upper);
    EXPECT_NEAR(found[0], 1, 1e-6) << far;
    EXPECT_NEAR(found[1], -1.0 / 3, 1e-6) << far;
  }
}

TEST(SmallestWithin, OfNothingIsNothing) {
  EXPECT_EQ(SmallestWithin(MatrixXd(0, 0), VectorXd(0), VectorXd(0), VectorXd(0)).size(), 0);
}

}  // namespace
}  // namespace tera
