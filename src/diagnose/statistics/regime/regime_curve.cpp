#include "diagnose/statistics/regime/regime_curve.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "diagnose/statistics/series/robust.h"
#include "diagnose/statistics/tests/block_bootstrap.h"

namespace tera {
namespace {

constexpr Eigen::Index kSplines = 20;
constexpr int kNewtonSteps = 6;  ///< Newton steps of Huber's regression
constexpr std::size_t kReplicatesOfBand = 300;
constexpr std::size_t kBlocksOfBand = 60;  ///< number of blocks in a recording
constexpr double kConfidenceOfBand = 0.9;

Series Less(const Series& residual, const RegimeAxis& axis, const Eigen::VectorXd& curve) {
  Series out = residual;
  for (std::size_t k = 0; k < out.size(); ++k) {
    if (out.valid[k]) {
      out.value[k] -= axis.times()[static_cast<Eigen::Index>(k)] * curve[axis.bin()[k]];
    }
  }
  return out;
}

double VarianceOf(const Series& series) {
  const std::vector<double> value = ValidValues(series);
  double mean = 0, variance = 0;
  for (const double x : value) mean += x / static_cast<double>(value.size());
  for (const double x : value) variance += (x - mean) * (x - mean);
  return variance / static_cast<double>(value.size());
}

struct Smoother {
  Eigen::MatrixXd splines, information, roughness;
  double penalty = 0;

  Eigen::LDLT<Eigen::MatrixXd> Solver(double weight) const {
    Eigen::MatrixXd normal = weight * information + penalty * roughness;
    normal.diagonal().array() += 1e-9 * normal.trace() / static_cast<double>(normal.rows());
    return Eigen::LDLT<Eigen::MatrixXd>(normal);
  }
  double Freedom() const { return Solver(1).solve(information).trace(); }
};

/// Chooses the penalty by generalised cross-validation: smallest (energy left) / (rows -
/// freedom)^2.
void ChoosePenalty(const Eigen::VectorXd& score, double energy, double rows, Smoother* smoother) {
  const double unit = smoother->information.trace() / std::max(smoother->roughness.trace(), 1e-300);
  double least = INFINITY, best = unit;
  for (double exponent = -7; exponent <= 5; exponent += 0.5) {
    smoother->penalty = unit * std::pow(10.0, exponent);
    const Eigen::VectorXd b = smoother->Solver(1).solve(score);
    const double left = energy - 2 * b.dot(score) + b.dot(smoother->information * b);
    const double denominator = rows - smoother->Freedom();
    const double fault = left / (denominator * denominator);
    if (fault >= least) continue;
    least = fault;
    best = smoother->penalty;
  }
  smoother->penalty = best;
}

/// Scores of the splines summed over blocks of rows: columns x blocks.
Eigen::MatrixXd BlockScores(const RegimeDesign& design, const RegimeAxis& axis,
                            const Eigen::MatrixXd& splines, const std::vector<Segment>& blocks) {
  const std::vector<double>& taps = design.filter().taps();
  const Eigen::MatrixXd through_known = design.SolveKnown(design.CrossByBin(axis).transpose());
  Eigen::MatrixXd out(splines.cols(), static_cast<Eigen::Index>(blocks.size()));
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(axis.bins());
    for (std::size_t t = blocks[b].begin; t < blocks[b].end; ++t) {
      if (!design.filter().rows()[t]) continue;
      const double psi = design.psi()[static_cast<Eigen::Index>(t)];
      for (std::size_t i = 0; i < taps.size(); ++i) {
        sum[axis.bin()[t - i]] += axis.times()[static_cast<Eigen::Index>(t - i)] * taps[i] * psi;
      }
    }
    const auto begin = static_cast<Eigen::Index>(blocks[b].begin);
    const auto length = static_cast<Eigen::Index>(blocks[b].size());
    const Eigen::VectorXd known = design.whitened_known().middleRows(begin, length).transpose() *
                                  design.psi().segment(begin, length);
    sum -= through_known.transpose() * known;
    out.col(static_cast<Eigen::Index>(b)) = splines.transpose() * sum;
  }
  return out;
}

/// The matrix that subtracts the mean over the samples from a curve.
Eigen::MatrixXd Centring(const Eigen::VectorXd& count) {
  Eigen::MatrixXd out = Eigen::MatrixXd::Identity(count.size(), count.size());
  out.rowwise() -= (count / count.sum()).transpose();
  return out;
}

void SetBand(const Eigen::MatrixXd& moved, double confidence, RegimeCurve* curve) {
  const auto replicates = static_cast<double>(moved.cols());
  curve->sigma = (moved.rowwise().squaredNorm() / replicates).cwiseSqrt();
  std::vector<double> largest;
  for (Eigen::Index r = 0; r < moved.cols(); ++r) {
    double most = 0;
    for (Eigen::Index b = 0; b < moved.rows(); ++b) {
      if (curve->count[b] == 0 || !(curve->sigma[b] > 0)) continue;
      most = std::max(most, std::abs(moved(b, r)) / curve->sigma[b]);
    }
    largest.push_back(most);
  }
  const double factor = Quantile(largest, confidence);
  curve->low = curve->mean - factor * curve->sigma;
  curve->high = curve->mean + factor * curve->sigma;
}

}  // namespace

RegimeCurve FitRegimeCurve(const Series& residual, const NoiseModel& noise,
                           const Eigen::MatrixXd& known, const RegimeVariable& variable,
                           const Stream& stream) {
  const RegimeAxis axis(variable);
  TERA_CHECK(axis.samples() == residual.size(), axis.samples(), residual.size());
  RegimeDesign design(residual, noise, known, 1e9);
  const Eigen::MatrixXd remaining =
      design.InformationBeyondKnown(axis, WhitenedGram(axis, design.filter()));
  Smoother smoother;
  smoother.splines = axis.Splines(kSplines);
  smoother.information = smoother.splines.transpose() * remaining * smoother.splines;
  smoother.roughness = axis.Roughness(kSplines);
  const auto rows = static_cast<double>(design.filter().row_count());

  Eigen::VectorXd b = Eigen::VectorXd::Zero(smoother.splines.cols());
  for (int step = 0; step < kNewtonSteps; ++step) {
    if (step > 0) design = RegimeDesign(Less(residual, axis, smoother.splines * b), noise, known);
    const Eigen::VectorXd score = smoother.splines.transpose() * SumByBin(axis, design.score());
    if (step == 0) ChoosePenalty(score, design.psi_variance() * rows, rows, &smoother);
    b += smoother.Solver(design.unclipped())
             .solve(score - smoother.penalty * (smoother.roughness * b));
  }
  const Eigen::VectorXd uncentred = smoother.splines * b;
  design = RegimeDesign(Less(residual, axis, uncentred), noise, known);

  RegimeCurve out;
  out.at = axis.centre();
  out.count = axis.count();
  out.angle = axis.angle();
  out.discrete = axis.discrete();
  out.rows = rows;
  const Eigen::MatrixXd centring = Centring(axis.count());
  out.mean = centring * uncentred;
  out.effective_freedom = smoother.Freedom();
  out.explained_share = std::max(
      0.0, 1 - VarianceOf(Less(residual, axis, out.mean)) / std::max(VarianceOf(residual), 1e-300));
  const double m = design.unclipped(), v = design.psi_variance();
  out.information = m * m / v * remaining;
  out.pull = out.information * uncentred + m / v * SumByBin(axis, design.score());

  const std::size_t length = std::max<std::size_t>(residual.size() / kBlocksOfBand, 1);
  const std::vector<Segment> blocks = CutIntoBlocks(residual.size(), length);
  const Eigen::MatrixXd scores = BlockScores(design, axis, smoother.splines, blocks);
  const Eigen::MatrixXd lift = centring * smoother.splines * smoother.Solver(m).solve(scores);
  Eigen::MatrixXd moved(lift.rows(), static_cast<Eigen::Index>(kReplicatesOfBand));
  for (std::size_t r = 0; r < kReplicatesOfBand; ++r) {
    const std::vector<int> drawn = DrawBlocks(blocks.size(), r, stream);
    Eigen::VectorXd times(static_cast<Eigen::Index>(blocks.size()));
    for (std::size_t k = 0; k < drawn.size(); ++k)
      times[static_cast<Eigen::Index>(k)] = drawn[k] - 1;
    moved.col(static_cast<Eigen::Index>(r)) = lift * times;
  }
  SetBand(moved, kConfidenceOfBand, &out);
  return out;
}

}  // namespace tera
