#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "diagnose/statistics/regime/regime_axis.h"
#include "diagnose/statistics/series/noise_model.h"
#include "diagnose/statistics/series/whitening.h"

namespace tera {

/// Regression of a residual y on known columns Z, prepared for score tests of further columns.
///
/// Model   generalised least squares under the noise model with Huber's function. e = A (y - Z g),
///         with the whitening filter A and g such that (A Z)' psi(e) = 0. psi(e) is e clipped at
///         `clip` robust scales; the scale is at least that of the noise. score = A' psi(e). A
///         function of a variable with bins B has the score vector B' score. Its information is B'
///         A' A B, minus the part that Z explains.
/// Source  Huber 1981, "Robust statistics", chapter 7 (modified residuals); Rao's score test.
class RegimeDesign {
 public:
  /// `known` has one row per sample; a constant is added. Gaps of `residual` are ignored.
  RegimeDesign(const Series& residual, const NoiseModel& noise, const Eigen::MatrixXd& known,
               double clip = 3);

  const WhiteningFilter& filter() const { return filter_; }
  const Eigen::VectorXd& psi() const { return psi_; }
  const Eigen::VectorXd& score() const { return score_; }
  /// Mean of psi^2 over the rows, and the share of rows without clipping.
  double psi_variance() const { return psi_variance_; }
  double unclipped() const { return unclipped_; }
  /// A Z.
  const Eigen::MatrixXd& whitened_known() const { return whitened_known_; }

  /// A' A Z, summed by bin. Rows: bins; columns: known columns.
  Eigen::MatrixXd CrossByBin(const RegimeAxis& axis) const;
  /// Solution x of (A Z)' A Z x = right.
  Eigen::MatrixXd SolveKnown(const Eigen::MatrixXd& right) const;
  /// Information of an axis that the known columns leave: the Schur complement of `gram`
  /// (WhitenedGram).
  Eigen::MatrixXd InformationBeyondKnown(const RegimeAxis& axis, const Eigen::MatrixXd& gram) const;

 private:
  void Fit(const Eigen::VectorXd& whitened, double clip, double least_scale);

  WhiteningFilter filter_;
  Eigen::MatrixXd whitened_known_;
  Eigen::LDLT<Eigen::MatrixXd> known_gram_;
  Eigen::VectorXd psi_, score_;
  double psi_variance_ = 0, unclipped_ = 1;
};

/// B' A' A B for the bins B of an axis, times the factor of the axis.
Eigen::MatrixXd WhitenedGram(const RegimeAxis& axis, const WhiteningFilter& filter);

}  // namespace tera
