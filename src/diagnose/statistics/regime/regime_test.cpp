#include "diagnose/statistics/regime/regime_test.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/check.h"

namespace tera {
namespace {

constexpr Eigen::Index kTestSplines = 10;
constexpr double kEffectiveFreedom = 5;
/// Smallest information of a direction, over that of the best known direction.
constexpr double kLeastInformation = 2e-3;
constexpr double kRounding = 1e-9;  ///< relative to the information of the mean
/// Smallest share of a direction's information that the known columns leave.
constexpr double kLeastShareBeyondKnown = 0.05;

/// Weights 1 / (1 + lambda roughness) with sum kEffectiveFreedom.
Eigen::VectorXd ShrinkingWeights(const Eigen::VectorXd& roughness) {
  const auto weights = [&](double lambda) -> Eigen::VectorXd {
    return (1 + lambda * roughness.array().max(0)).inverse().matrix();
  };
  if (static_cast<double>(roughness.size()) <= kEffectiveFreedom) return weights(0);
  double low = -40, high = 40;
  for (int step = 0; step < 60; ++step) {
    const double middle = (low + high) / 2;
    (weights(std::exp(middle)).sum() > kEffectiveFreedom ? low : high) = middle;
  }
  return weights(std::exp(low));
}

/// The tested directions: eigenvectors Q with eigenvalues mu of the information that the known
/// columns leave.
struct JudgedDirections {
  Eigen::MatrixXd project;    ///< Q Q'
  Eigen::MatrixXd normalise;  ///< Q mu^-1/2 Q', which gives scores unit variance
  double count = 0;
};

JudgedDirections JudgedDirectionsOf(const Eigen::MatrixXd& information) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(information);
  JudgedDirections out;
  out.project = out.normalise = Eigen::MatrixXd::Zero(information.rows(), information.rows());
  for (Eigen::Index k = 0; k < information.rows(); ++k) {
    const double left = solver.eigenvalues()[k];
    if (left < kLeastShareBeyondKnown) continue;
    const Eigen::VectorXd q = solver.eigenvectors().col(k);
    out.project += q * q.transpose();
    out.normalise += q * q.transpose() / std::sqrt(left);
    ++out.count;
  }
  return out;
}

/// Sums of a score over the bins of a variable that is shifted circularly by `offset` samples.
Eigen::VectorXd ShiftedSumByBin(const RegimeAxis& axis, const Eigen::VectorXd& score,
                                std::size_t offset) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(axis.bins());
  const std::uint8_t* bin = axis.bin().data();
  const std::size_t seam = axis.samples() - offset;  // index that wraps to the first sample
  for (std::size_t i = 0; i < seam; ++i) sum[bin[i]] += score.data()[offset + i];
  for (std::size_t i = seam; i < axis.samples(); ++i) sum[bin[i]] += score.data()[i - seam];
  return sum;
}

}  // namespace

RegimeProbe::RegimeProbe(const RegimeVariable& variable, const WhiteningFilter& filter)
    : name_(variable.name), axis_(variable), gram_(WhitenedGram(axis_, filter)) {
  const Eigen::VectorXd constant = filter.Apply(axis_.times());
  const Eigen::VectorXd cross = SumByBin(axis_, filter.Transposed(constant));
  const Eigen::MatrixXd centred =
      gram_ - cross * cross.transpose() / std::max(constant.squaredNorm(), 1e-300);

  const Eigen::MatrixXd splines = axis_.Splines(kTestSplines);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> information(splines.transpose() * centred *
                                                                   splines);
  const Eigen::VectorXd& known = information.eigenvalues();
  const double least = std::max(kLeastInformation * known.maxCoeff(),
                                kRounding * (splines.transpose() * gram_ * splines).trace());
  const Eigen::Index kept = (known.array() > least).count();
  directions_.resize(axis_.bins(), kept);
  weights_.resize(kept);
  if (kept == 0) return;  // the variable is constant, and Eigen cannot decompose an empty matrix
  const Eigen::MatrixXd unit = information.eigenvectors().rightCols(kept) *
                               known.tail(kept).cwiseSqrt().cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> rough(unit.transpose() *
                                                             axis_.Roughness(kTestSplines) * unit);
  directions_ = splines * unit * rough.eigenvectors();
  weights_ = ShrinkingWeights(rough.eigenvalues());
}

RegimeTestResult TestRegime(const RegimeDesign& design, const RegimeProbe& probe,
                            const RegimeTestOptions& options, const Stream& stream) {
  RegimeTestResult out;
  out.name = probe.name();
  if (probe.directions().cols() == 0) return out;
  const RegimeAxis& axis = probe.axis();
  const Eigen::MatrixXd& directions = probe.directions();
  const JudgedDirections judged = JudgedDirectionsOf(
      directions.transpose() * design.InformationBeyondKnown(axis, probe.gram()) * directions);
  if (judged.count == 0) return out;

  const double unit = 1 / std::sqrt(design.psi_variance());
  const auto energy = [&](const Eigen::VectorXd& score) {
    return probe.weights().dot(score.cwiseAbs2());
  };
  const Eigen::VectorXd observed =
      unit * judged.normalise * (directions.transpose() * SumByBin(axis, design.score()));
  const auto rows = static_cast<double>(design.filter().row_count());
  const double by_chance = judged.count * options.repeats;
  out.share = std::max(0.0, (observed.squaredNorm() - by_chance) / rows);
  const double price = std::max(by_chance, judged.count * std::log(rows));
  out.criterion = (observed.squaredNorm() - price) / rows;
  out.whole_criterion = out.criterion;

  const std::size_t least = std::max(axis.correlation_length(), 2 * design.filter().taps().size());
  const std::vector<std::size_t> offsets =
      CircularShifts(axis.samples(), least, options.shifts, stream);
  const Eigen::VectorXd score = axis.times().cwiseProduct(design.score());
  std::vector<double> shifted(offsets.size());
  for (std::size_t k = 0; k < offsets.size(); ++k) {
    const Eigen::VectorXd sum = ShiftedSumByBin(axis, score, offsets[k]);
    shifted[k] = energy(unit * judged.project * (directions.transpose() * sum));
  }
  out.comparison = CompareWithShifts(energy(observed), std::move(shifted));
  return out;
}

}  // namespace tera
