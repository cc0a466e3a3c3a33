#include "diagnose/statistics/regime/regime_design.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/check.h"
#include "diagnose/statistics/series/robust.h"

namespace tera {
namespace {

double RowScale(const Eigen::VectorXd& error, const Mask& rows) {
  std::vector<double> values;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (rows[k]) values.push_back(error[static_cast<Eigen::Index>(k)]);
  }
  return std::max(RobustScale(values), 1e-300);
}

}  // namespace

RegimeDesign::RegimeDesign(const Series& residual, const NoiseModel& noise,
                           const Eigen::MatrixXd& known, double clip)
    : filter_(noise, residual.valid) {
  const auto n = static_cast<Eigen::Index>(residual.size());
  TERA_CHECK(known.rows() == n || known.cols() == 0, known.rows(), n);
  TERA_CHECK(filter_.row_count() > static_cast<std::size_t>(known.cols()) + 1, filter_.row_count());
  whitened_known_.resize(n, known.cols() + 1);
  whitened_known_.col(0) = filter_.Apply(Eigen::VectorXd::Ones(n));
  for (Eigen::Index c = 0; c < known.cols(); ++c) {
    whitened_known_.col(c + 1) = filter_.Apply(known.col(c));
  }
  Eigen::MatrixXd gram = whitened_known_.transpose() * whitened_known_;
  gram.diagonal() *= 1 + 1e-8;
  gram.diagonal().array() += 1e-12 * gram.trace() + 1e-300;
  known_gram_.compute(gram);
  Fit(filter_.Apply(Eigen::Map<const Eigen::VectorXd>(residual.value.data(), n)), clip,
      noise.scale);
}

void RegimeDesign::Fit(const Eigen::VectorXd& whitened, double clip, double least_scale) {
  Eigen::VectorXd error =
      whitened - whitened_known_ * SolveKnown(whitened_known_.transpose() * whitened);
  const double limit = clip * std::max(least_scale, RowScale(error, filter_.rows()));
  for (int step = 0; step < 12; ++step) {
    psi_ = error.cwiseMax(-limit).cwiseMin(limit);
    const Eigen::VectorXd pull = whitened_known_.transpose() * psi_;
    const Eigen::VectorXd move = SolveKnown(pull);
    if (pull.dot(move) < 1e-6 * psi_.squaredNorm() / static_cast<double>(psi_.size())) break;
    error -= whitened_known_ * move;
  }
  const auto rows = static_cast<double>(filter_.row_count());
  psi_variance_ = std::max(psi_.squaredNorm() / rows, 1e-300);
  unclipped_ = std::max(1 - static_cast<double>((error.array().abs() > limit).count()) / rows, 0.1);
  score_ = filter_.Transposed(psi_);
}

Eigen::MatrixXd RegimeDesign::CrossByBin(const RegimeAxis& axis) const {
  Eigen::MatrixXd cross(axis.bins(), whitened_known_.cols());
  for (Eigen::Index c = 0; c < cross.cols(); ++c) {
    cross.col(c) = SumByBin(axis, filter_.Transposed(whitened_known_.col(c)));
  }
  return cross;
}

Eigen::MatrixXd RegimeDesign::SolveKnown(const Eigen::MatrixXd& right) const {
  return known_gram_.solve(right);
}

Eigen::MatrixXd RegimeDesign::InformationBeyondKnown(const RegimeAxis& axis,
                                                     const Eigen::MatrixXd& gram) const {
  const Eigen::MatrixXd cross = CrossByBin(axis);
  return gram - cross * SolveKnown(cross.transpose());
}

Eigen::MatrixXd WhitenedGram(const RegimeAxis& axis, const WhiteningFilter& filter) {
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(axis.bins(), axis.bins());
  const std::vector<double>& taps = filter.taps();
  const std::vector<std::uint8_t>& bin = axis.bin();
  std::array<double, 256> weight{};
  std::vector<std::uint8_t> touched;
  for (std::size_t t = 0; t < axis.samples(); ++t) {
    if (!filter.rows()[t]) continue;
    touched.clear();
    for (std::size_t i = 0; i < taps.size(); ++i) {
      const std::uint8_t b = bin[t - i];
      if (std::find(touched.begin(), touched.end(), b) == touched.end()) touched.push_back(b);
      weight[b] += taps[i] * axis.times()[static_cast<Eigen::Index>(t - i)];
    }
    for (const std::uint8_t a : touched) {
      for (const std::uint8_t b : touched) gram(a, b) += weight[a] * weight[b];
    }
    for (const std::uint8_t b : touched) weight[b] = 0;
  }
  return gram;
}

}  // namespace tera
