#include "diagnose/search/likelihood.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/check.h"

namespace tera {
namespace {

constexpr int kReweightings = 2;

/// Central difference; ends as their neighbours.
std::vector<double> Slope(const std::vector<double>& y, double period_s) {
  std::vector<double> slope(y.size(), 0.0);
  for (std::size_t k = 1; k + 1 < y.size(); ++k) slope[k] = (y[k + 1] - y[k - 1]) / (2 * period_s);
  if (y.size() > 2) {
    slope.front() = slope[1];
    slope.back() = slope[y.size() - 2];
  }
  return slope;
}

Eigen::Map<const Eigen::VectorXd> AsVector(const std::vector<double>& x) {
  return {x.data(), static_cast<Eigen::Index>(x.size())};
}

/// Nuisances as columns, each times its standard deviation.
Eigen::MatrixXd ColumnsOf(const std::vector<double>& predicted, double period_s,
                          const Nuisances& sigma) {
  Eigen::MatrixXd columns(static_cast<Eigen::Index>(predicted.size()), 3);
  columns.col(0).setConstant(sigma.offset);
  columns.col(1) = sigma.gain * AsVector(predicted);
  columns.col(2) = -sigma.delay_s * AsVector(Slope(predicted, period_s));
  return columns;
}

/// Student-t regression of y on the columns, unit normal prior on the coefficients, over the rows.
Eigen::Vector3d Regress(const Eigen::VectorXd& y, const Eigen::MatrixXd& columns,
                        const std::vector<Eigen::Index>& rows, double dof) {
  Eigen::Vector3d beta = Eigen::Vector3d::Zero();
  for (int pass = 0; pass < kReweightings; ++pass) {
    Eigen::Matrix3d information = Eigen::Matrix3d::Identity();
    Eigen::Vector3d pull = Eigen::Vector3d::Zero();
    for (const Eigen::Index k : rows) {
      const Eigen::Vector3d x = columns.row(k).transpose();
      const double e = y[k] - x.dot(beta);
      const double weight = (dof + 1) / (dof + e * e);
      information.noalias() += weight * x * x.transpose();
      pull.noalias() += weight * y[k] * x;
    }
    beta = information.ldlt().solve(pull);
  }
  return beta;
}

}  // namespace

double LogDensityOf(double innovation, double dof) {
  return -0.5 * (dof + 1) * std::log1p(innovation * innovation / dof);
}

Likelihood::Likelihood(const ReplayBlock& block, std::vector<NoiseModel> noise)
    : block_(block), noise_(std::move(noise)) {
  TERA_CHECK(noise_.size() == block.channels.size(), noise_.size(), block.channels.size());
  for (std::size_t c = 0; c < noise_.size(); ++c) {
    filter_.emplace_back(noise_[c], block.channels[c].measured.valid);
  }
}

Misfit Likelihood::Leave(const std::vector<Eigen::VectorXd>& measured,
                         const std::vector<std::vector<double>>& predicted,
                         const Mask& fit_on) const {
  Misfit out;
  for (std::size_t c = 0; c < noise_.size(); ++c) {
    const Channel& channel = block_.channels[c];
    TERA_CHECK(predicted[c].size() == channel.measured.size(), predicted[c].size());
    const double scale = noise_[c].scale;
    const Eigen::MatrixXd columns =
        ColumnsOf(predicted[c], channel.measured.period_s, channel.nuisances);
    Eigen::VectorXd y = measured[c] - AsVector(predicted[c]);
    const Eigen::VectorXd white = filter_[c].Apply(y) / scale;
    Eigen::MatrixXd white_columns(columns.rows(), 3);
    for (int i = 0; i < 3; ++i) white_columns.col(i) = filter_[c].Apply(columns.col(i)) / scale;
    std::vector<Eigen::Index> rows;
    for (std::size_t k = 0; k < fit_on.size(); ++k) {
      if (fit_on[k] && filter_[c].rows()[k]) rows.push_back(static_cast<Eigen::Index>(k));
    }
    const Eigen::Vector3d beta = Regress(white, white_columns, rows, noise_[c].dof);
    out.nuisances.push_back(beta);
    out.innovation.push_back(white - white_columns * beta);
    y -= columns * beta;
    Series residual = channel.measured;
    for (std::size_t k = 0; k < residual.size(); ++k) {
      residual.value[k] = residual.valid[k] ? y[static_cast<Eigen::Index>(k)] : 0;
    }
    out.residual.push_back(std::move(residual));
  }
  return out;
}

Misfit Likelihood::Judge(const std::vector<std::vector<double>>& predicted,
                         const Mask& fit_on) const {
  std::vector<Eigen::VectorXd> measured;
  for (const Channel& channel : block_.channels)
    measured.push_back(AsVector(channel.measured.value));
  return Leave(measured, predicted, fit_on);
}

double Likelihood::Discernible(const std::vector<std::vector<double>>& predicted,
                               const std::vector<std::vector<double>>& truth,
                               const Mask& mask) const {
  std::vector<Eigen::VectorXd> measured;
  for (const std::vector<double>& channel : truth) measured.push_back(AsVector(channel));
  return -SumWithPenalty(Leave(measured, predicted, mask), mask);
}

double Likelihood::Sum(const Misfit& misfit, const Segment& samples) const {
  double sum = 0;
  for (std::size_t c = 0; c < noise_.size(); ++c) {
    for (std::size_t k = samples.begin; k < samples.end; ++k) {
      if (!rows(c)[k]) continue;
      sum += LogDensityOf(misfit.innovation[c][static_cast<Eigen::Index>(k)], noise_[c].dof);
    }
  }
  return sum;
}

double Likelihood::SumWithPenalty(const Misfit& misfit, const Mask& mask) const {
  double sum = 0;
  for (std::size_t c = 0; c < noise_.size(); ++c) {
    sum -= 0.5 * misfit.nuisances[c].squaredNorm();
    for (std::size_t k = 0; k < mask.size(); ++k) {
      if (!mask[k] || !rows(c)[k]) continue;
      sum += LogDensityOf(misfit.innovation[c][static_cast<Eigen::Index>(k)], noise_[c].dof);
    }
  }
  return sum;
}

}  // namespace tera
