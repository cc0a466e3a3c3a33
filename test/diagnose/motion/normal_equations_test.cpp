#include "diagnose/motion/normal_equations.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "diagnose/motion/made_problem.h"

// The block-tridiagonal solution against a dense one.

namespace tera {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// All rows of a problem, stacked and each divided by its sigma.
struct Dense {
  MatrixXd motion, parameters;
  VectorXd residual;

  void Append(const MatrixXd& by_motion, const MatrixXd& by_parameters, const VectorXd& r) {
    const int at = static_cast<int>(residual.size()), rows = static_cast<int>(r.size());
    motion.conservativeResize(at + rows, by_motion.cols());
    parameters.conservativeResize(at + rows, by_parameters.cols());
    residual.conservativeResize(at + rows);
    motion.bottomRows(rows) = by_motion;
    parameters.bottomRows(rows) = by_parameters;
    residual.tail(rows) = r;
  }
};

struct Both {
  MadeProblem made;
  NormalEquations equations;
  Dense dense;

  explicit Both(std::uint64_t seed)
      : made(seed),
        equations(made.spline.coefficients, made.problem.numbers(), made.problem.parameters) {
    const Stream draw(seed, "rows");
    int drawn = 0;
    for (int k = 0; k < 25; ++k) {
      for (Observation seen : made.Observations()) {
        const double length_s = seen.to_s - seen.from_s;
        seen.from_s = 0.3 + (made.spline.end_s() - 0.8) * draw.Uniform(++drawn);
        seen.to_s = seen.from_s + length_s;
        Add(seen, draw, ++drawn);
      }
    }
    // A prior holds the unmeasured first and last coefficients.
    const int numbers = made.problem.numbers();
    for (int i = 0; i < made.spline.coefficients; ++i) {
      for (int number = 0; number < numbers; ++number) AddPrior(i, number, {1}, 0.1, 2);
    }
    for (int i = 0; i + 3 < made.spline.coefficients; ++i) {
      for (int number = 0; number < numbers; ++number) AddPrior(i, number, {-1, 3, -3, 1}, -0.3, 5);
    }
  }
  void Add(const Observation& seen, const Stream& draw, int drawn) {
    LinearisedObservation rows;
    ASSERT_TRUE(made.Of(seen, &rows));
    Eigen::Matrix<double, 6, 1> weight = Eigen::Matrix<double, 6, 1>::Zero();
    for (int i = 0; i < rows.rows; ++i) weight[i] = 0.2 + draw.Uniform(drawn, 1 + i);
    equations.Add(rows, weight);
    const VectorXd root = weight.head(rows.rows).cwiseSqrt();
    dense.Append(root.asDiagonal() * made.ByCoefficients(rows),
                 root.asDiagonal() * made.ByParameters(rows),
                 root.asDiagonal() * rows.residual.head(rows.rows));
  }
  void AddPrior(int first, int number, const std::vector<double>& pattern, double residual,
                double weight) {
    equations.AddPrior(first, number, pattern, residual, weight);
    const int numbers = made.problem.numbers();
    MatrixXd by = MatrixXd::Zero(1, made.coefficients.size());
    for (std::size_t k = 0; k < pattern.size(); ++k) {
      by(0, (first + static_cast<int>(k)) * numbers + number) = pattern[k];
    }
    const double root = std::sqrt(weight);
    // As for an observation, the residual is the target minus the value.
    dense.Append(root * by, MatrixXd::Zero(1, made.problem.parameters),
                 VectorXd::Constant(1, root * residual));
  }
};

TEST(NormalEquations, LeaveForTheParametersWhatADenseEliminationDoes) {
  for (const std::uint64_t seed : {1, 2}) {
    Both both(seed);
    const Dense& dense = both.dense;
    const ParameterQuadratic reduced = both.equations.Reduce();

    const MatrixXd A = dense.motion.transpose() * dense.motion;
    const MatrixXd C = dense.motion.transpose() * dense.parameters;
    const VectorXd g = dense.motion.transpose() * dense.residual;
    const Eigen::LLT<MatrixXd> solver(A);
    const MatrixXd information =
        dense.parameters.transpose() * dense.parameters - C.transpose() * solver.solve(C);
    const VectorXd score =
        dense.parameters.transpose() * dense.residual - C.transpose() * solver.solve(g);
    const double size = information.norm();
    EXPECT_LT((reduced.information - information).norm(), 1e-9 * size);
    EXPECT_LT((reduced.score - score).norm(), 1e-9 * (1 + score.norm()));
    EXPECT_LT((reduced.information - reduced.information.transpose()).norm(), 1e-9 * size);
    const VectorXd change = VectorXd::LinSpaced(score.size(), -1, 2);
    const VectorXd step = solver.solve(g - C * change);
    EXPECT_LT((both.equations.MotionStep(change) - step).norm(), 1e-9 * step.norm());

    const MatrixXd covariance = solver.solve(MatrixXd::Identity(A.rows(), A.cols()));
    const int block = 4 * both.made.problem.numbers();
    const std::vector<MatrixXd> blocks = both.equations.Covariance();
    ASSERT_EQ(static_cast<int>(blocks.size()) * block, A.rows());
    for (std::size_t k = 0; k < blocks.size(); ++k) {
      const MatrixXd expected = covariance.block(k * block, k * block, block, block);
      EXPECT_LT((blocks[k] - expected).norm(), 1e-9 * expected.norm()) << "block " << k;
    }
  }
}

// The joint optimum of parameters and motion is that of a single least-squares problem.
TEST(NormalEquations, HaveTheSolutionOfOneLeastSquaresOfEverything) {
  Both both(3);
  ParameterQuadratic reduced = both.equations.Reduce();
  const int n = static_cast<int>(reduced.score.size());
  const int m = static_cast<int>(both.dense.motion.cols());
  const double prior = 10;
  MatrixXd all(both.dense.residual.size() + n, m + n);
  all << both.dense.motion, both.dense.parameters, MatrixXd::Zero(n, m),
      std::sqrt(prior) * MatrixXd::Identity(n, n);
  VectorXd right(both.dense.residual.size() + n);
  right << both.dense.residual, VectorXd::Zero(n);
  const VectorXd expected = all.householderQr().solve(right);

  reduced.information += prior * MatrixXd::Identity(n, n);
  const VectorXd p = reduced.information.llt().solve(reduced.score);
  EXPECT_LT((p - expected.tail(n)).norm(), 1e-8 * expected.tail(n).norm());
  const VectorXd motion = both.equations.MotionStep(p);
  EXPECT_LT((motion - expected.head(m)).norm(), 1e-8 * expected.head(m).norm());
}

TEST(ParameterQuadratic, IsLeastWhereTheInformationTimesTheParametersIsTheScore) {
  ParameterQuadratic quadratic;
  quadratic.information = Eigen::Matrix2d::Identity() * 2;
  quadratic.score = Eigen::Vector2d(4, -6);
  EXPECT_DOUBLE_EQ(quadratic.At(Eigen::Vector2d(2, -3)), -13);  // 4 + 9 - 8 - 18
  EXPECT_DOUBLE_EQ(quadratic.At(Eigen::Vector2d(0, 0)), 0);
}

}  // namespace
}  // namespace tera
