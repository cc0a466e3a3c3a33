#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/random.h"
#include "diagnose/statistics/regime/regime_design.h"

namespace tera {

/// The dependence of a residual on a variable, E[residual | variable], with known columns held
/// fixed.
///
/// Model   20 penalised cubic B-splines by generalised least squares with Huber's function. The
///         penalty follows from generalised cross-validation. The mean over the samples is 0. Band:
///         block bootstrap of the scores, with the linearised estimate. `low` and `high` enclose
///         the whole curve over the occupied bins with 90 % confidence. For a variable with a
///         factor, the curve multiplies that factor.
/// Omits   the bias of smoothing; the offset, which a coloured residual hardly determines.
/// Source  Eilers and Marx 1996; Craven and Wahba 1979; Künsch 1989.
struct RegimeCurve {
  Eigen::VectorXd at, mean, sigma, low, high;  ///< one entry per bin
  Eigen::VectorXd count;                       ///< samples in each bin
  bool angle = false, discrete = false;
  double effective_freedom = 0;
  double explained_share = 0;  ///< share of the residual's variance, 1 - var(y - f) / var(y)
  /// For hypotheses about the curve: a function f of the bins has log-likelihood pull' f - f'
  /// information f / 2.
  Eigen::MatrixXd information;
  Eigen::VectorXd pull;
  double rows = 0;
};

RegimeCurve FitRegimeCurve(const Series& residual, const NoiseModel& noise,
                           const Eigen::MatrixXd& known, const RegimeVariable& variable,
                           const Stream& stream);

}  // namespace tera
