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

ParameterQuadratic NormalEquations::Reduce() {
  Eigen::MatrixXd square;
  for (int k = 0; k < blocks_; ++k) {
    const auto b = static_cast<std::size_t>(k);
    auto rows = right_.middleRows(k * block_, block_);
    square = pair_[b].topLeftCorner(block_, block_);
    if (k > 0) {
      square += pair_[b - 1].bottomRightCorner(block_, block_);
      square.noalias() -= below_[b - 1] * below_[b - 1].transpose();
      rows.noalias() -= below_[b - 1] * right_.middleRows((k - 1) * block_, block_);
    }
    factor_.push_back(square.llt().matrixL());
    factor_[b].triangularView<Eigen::Lower>().solveInPlace(rows);
    below_.push_back(pair_[b].bottomLeftCorner(block_, block_));
    factor_[b].transpose().triangularView<Eigen::Upper>().solveInPlace<Eigen::OnTheRight>(
        below_[b]);
  }
  pair_.clear();
  const auto coupling = right_.leftCols(parameters_);
  information_.selfadjointView<Eigen::Lower>().rankUpdate(coupling.transpose(), -1);
  return {Eigen::MatrixXd(information_.selfadjointView<Eigen::Lower>()),
          score_ - coupling.transpose() * right_.col(parameters_)};
}

Eigen::VectorXd NormalEquations::MotionStep(const Eigen::VectorXd& change) const {
  Eigen::VectorXd step = right_.col(parameters_) - right_.leftCols(parameters_) * change;
  for (int k = blocks_ - 1; k >= 0; --k) {
    const auto b = static_cast<std::size_t>(k);
    auto rows = step.segment(k * block_, block_);
    if (k + 1 < blocks_) {
      rows.noalias() -= below_[b].transpose() * step.segment((k + 1) * block_, block_);
    }
    factor_[b].transpose().triangularView<Eigen::Upper>().solveInPlace(rows);
  }
  return step;
}

std::vector<Eigen::MatrixXd> NormalEquations::Covariance() const {
  std::vector<Eigen::MatrixXd> covariance(static_cast<std::size_t>(blocks_));
  for (auto b = covariance.size(); b-- > 0;) {
    const Eigen::MatrixXd transposed = factor_[b].transpose();
    const auto upper = transposed.triangularView<Eigen::Upper>();
    Eigen::MatrixXd middle = Eigen::MatrixXd::Identity(block_, block_);
    if (b + 1 < covariance.size()) {
      middle.noalias() += below_[b].transpose() * covariance[b + 1] * below_[b];
    }
    upper.solveInPlace(middle);
    covariance[b] = upper.solve(middle.transpose());
  }
  return covariance;
}

}  // namespace tera
