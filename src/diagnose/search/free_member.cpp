#include "diagnose/search/free_member.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "diagnose/statistics/robust.h"
#include "diagnose/statistics/whitening.h"

namespace tera {
namespace {

constexpr double kClip = 3;
constexpr double kRidge = 1e-6;
constexpr int kReweightings = 3;
constexpr std::size_t kHighestOrder = 10;
/// A machine that rests half the time leaves residuals of two scales; with heavier tails, that
/// would pass for outliers, and being right at rest would be all that counts.
constexpr double kLeastDof = 4;
constexpr double kFloor = 2e-3;  ///< of the channel's RMS: replays are no better

/// Coefficients of y on the columns over the rows, Huber's weights.
Eigen::VectorXd Regress(const Eigen::VectorXd& y, const Eigen::MatrixXd& columns,
                        const std::vector<Eigen::Index>& rows) {
  Eigen::VectorXd beta = Eigen::VectorXd::Zero(columns.cols());
  const Eigen::MatrixXd x = columns(rows, Eigen::all);
  const Eigen::VectorXd wanted = y(rows);
  for (int pass = 0; pass < kReweightings; ++pass) {
    const Eigen::VectorXd left = wanted - x * beta;
    const double limit = kClip * RobustScale({left.begin(), left.end()});
    const Eigen::VectorXd weight = left.unaryExpr([&](double e) {
      return pass == 0 || limit <= 0 ? 1.0 : std::min(1.0, limit / std::max(std::abs(e), 1e-300));
    });
    Eigen::MatrixXd information = x.transpose() * weight.asDiagonal() * x;
    information.diagonal() *= 1 + kRidge;
    information.diagonal().array() += 1e-300;
    beta = information.ldlt().solve(x.transpose() * (weight.asDiagonal() * wanted));
  }
  return beta;
}

Eigen::MatrixXd WithConstant(const Eigen::MatrixXd& columns, Eigen::Index rows) {
  Eigen::MatrixXd out(rows, columns.cols() + 1);
  out.col(0).setOnes();
  if (columns.cols() > 0) out.rightCols(columns.cols()) = columns;
  return out;
}

double RmsOf(const Series& series) {
  double sum = 0;
  for (const double x : series.value) sum += x * x;  // gaps are 0
  return std::sqrt(sum / std::max(1.0, static_cast<double>(CountValid(series.valid))));
}

}  // namespace

Series LessFreeMember(const Channel& channel, const Series& residual, const NoiseModel& noise,
                      const Mask& fit_on) {
  const auto size = static_cast<Eigen::Index>(residual.size());
  const WhiteningFilter filter(noise, residual.valid);
  const Eigen::Map<const Eigen::VectorXd> y(residual.value.data(), size);
  const Eigen::MatrixXd columns = WithConstant(channel.free_member, size);
  Eigen::MatrixXd white(columns.rows(), columns.cols());
  for (Eigen::Index c = 0; c < columns.cols(); ++c) white.col(c) = filter.Apply(columns.col(c));
  std::vector<Eigen::Index> rows;
  for (std::size_t k = 0; k < residual.size(); ++k) {
    if (fit_on[k] && filter.rows()[k]) rows.push_back(static_cast<Eigen::Index>(k));
  }
  Series out = residual;
  if (static_cast<Eigen::Index>(rows.size()) <= 2 * columns.cols()) return out;
  const Eigen::VectorXd explained = columns * Regress(filter.Apply(y), white, rows);
  for (std::size_t k = 0; k < out.size(); ++k) {
    if (out.valid[k]) out.value[k] -= explained[static_cast<Eigen::Index>(k)];
  }
  return out;
}

std::vector<NoiseModel> NoiseOfBlock(const ReplayBlock& block) {
  const auto predicted = block.predict({});
  std::vector<NoiseModel> noise;
  for (std::size_t c = 0; c < block.channels.size(); ++c) {
    const Channel& channel = block.channels[c];
    Series residual = channel.measured;
    for (std::size_t k = 0; k < residual.size(); ++k) {
      if (residual.valid[k]) residual.value[k] -= predicted[c][k];
    }
    const Mask everywhere(residual.size(), 1);
    const Series left = LessFreeMember(channel, residual, {}, everywhere);
    noise.push_back(FitNoise(
        left, {.highest_order = kHighestOrder, .least_dof = kLeastDof, .estimate_mean = false}));
    noise.back().scale = std::max({noise.back().scale, kFloor * RmsOf(channel.measured), 1e-9});
  }
  return noise;
}

}  // namespace tera
