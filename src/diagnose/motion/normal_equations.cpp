#include "diagnose/motion/normal_equations.h"

#include <Eigen/Cholesky>

namespace tera {

NormalEquations::NormalEquations(int coefficients, int numbers, int parameters)
    : block_(4 * numbers),
      blocks_(coefficients / 4),
      numbers_(numbers),
      parameters_(parameters),
      pair_(static_cast<std::size_t>(blocks_), Eigen::MatrixXd::Zero(2 * block_, 2 * block_)),
      right_(Eigen::MatrixXd::Zero(blocks_ * block_, parameters + 1)),
      information_(Eigen::MatrixXd::Zero(parameters, parameters)),
      score_(Eigen::VectorXd::Zero(parameters)) {}

void NormalEquations::Add(const LinearisedObservation& rows,
                          const Eigen::Matrix<double, 6, 1>& weight) {
  const int first = rows.weights.first, width = 5 * numbers_;
  const int columns = std::min(width, blocks_ * block_ - first * numbers_);
  Eigen::MatrixXd J(rows.rows, width);
  J.setZero();
  for (int k = 0; k < 3; ++k) {
    const auto by = rows.by_state.block(0, k * numbers_, rows.rows, numbers_);
    for (int i = 0; i < 5; ++i) {
      J.middleCols(i * numbers_, numbers_) += rows.weights.by_derivative(k, i) * by;
    }
  }
  const Eigen::MatrixXd WJ = weight.head(rows.rows).asDiagonal() * J.leftCols(columns);
  Eigen::MatrixXd& pair = pair_[static_cast<std::size_t>(first / 4)];
  const int at = (first % 4) * numbers_;
  pair.block(at, at, columns, columns).noalias() += J.leftCols(columns).transpose() * WJ;
  auto right = right_.middleRows(first * numbers_, columns);
  const Eigen::VectorXd residual = rows.residual.head(rows.rows);
  right.col(parameters_).noalias() += WJ.transpose() * residual;
  const auto P = rows.by_parameter.topLeftCorner(rows.rows, rows.parameters);
  const Eigen::MatrixXd WP = weight.head(rows.rows).asDiagonal() * P;
  const Eigen::MatrixXd coupling = WJ.transpose() * P, square = P.transpose() * WP;
  const Eigen::VectorXd pull = WP.transpose() * residual;
  for (int a = 0; a < rows.parameters; ++a) {
    const int place = rows.parameter[static_cast<std::size_t>(a)];
    right.col(place) += coupling.col(a);
    score_[place] += pull[a];
    for (int b = 0; b < rows.parameters; ++b) {
      information_(place, rows.parameter[static_cast<std::size_t>(b)]) += square(a, b);
    }
  }
}

void NormalEquations::AddPrior(int first, int number, const std::vector<double>& pattern,
                               double residual, double weight) {
  Eigen::MatrixXd& pair = pair_[static_cast<std::size_t>(first / 4)];
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    const int row = first + static_cast<int>(i);
    right_(row * numbers_ + number, parameters_) += weight * pattern[i] * residual;
    for (std::size_t j = 0; j < pattern.size(); ++j) {
      pair((first % 4 + static_cast<int>(i)) * numbers_ + number,
           (first % 4 + static_cast<int>(j)) * numbers_ + number) +=
          weight * pattern[i] * pattern[j];
    }
  }
}

ParameterQuadratic NormalEquations::Reduce(MotionStep* step) const {
  std::vector<Eigen::LLT<Eigen::MatrixXd>> factors(static_cast<std::size_t>(blocks_));
  Eigen::MatrixXd solution = right_;
  const auto rows = [&](int k) { return solution.middleRows(k * block_, block_); };
  Eigen::MatrixXd square;
  for (int k = 0; k < blocks_; ++k) {
    const auto b = static_cast<std::size_t>(k);
    square = pair_[b].topLeftCorner(block_, block_);
    if (k > 0) {
      const auto below = pair_[b - 1].bottomLeftCorner(block_, block_);
      square += pair_[b - 1].bottomRightCorner(block_, block_);
      square.noalias() -= below * factors[b - 1].solve(below.transpose());
      const Eigen::MatrixXd carried = factors[b - 1].solve(rows(k - 1));
      rows(k).noalias() -= below * carried;
    }
    factors[b].compute(square);
  }
  step->covariance.resize(static_cast<std::size_t>(blocks_));
  for (int k = blocks_ - 1; k >= 0; --k) {
    const auto b = static_cast<std::size_t>(k);
    if (k + 1 < blocks_) {
      rows(k).noalias() -= pair_[b].bottomLeftCorner(block_, block_).transpose() * rows(k + 1);
    }
    factors[b].solveInPlace(rows(k));
    Eigen::MatrixXd& covariance = step->covariance[b];
    covariance = factors[b].solve(Eigen::MatrixXd::Identity(block_, block_));
    if (k + 1 == blocks_) continue;
    const Eigen::MatrixXd gain = pair_[b].bottomLeftCorner(block_, block_) * covariance;
    covariance += gain.transpose() * step->covariance[b + 1] * gain;
  }
  const auto coupling = right_.leftCols(parameters_);
  ParameterQuadratic reduced;
  step->without = solution.col(parameters_);
  step->by_parameter = solution.leftCols(parameters_);
  reduced.information = information_ - coupling.transpose() * step->by_parameter;
  reduced.information = 0.5 * (reduced.information + reduced.information.transpose()).eval();
  reduced.score = score_ - coupling.transpose() * step->without;
  return reduced;
}

}  // namespace tera
