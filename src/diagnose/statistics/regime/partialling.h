#pragma once

#include <vector>

#include "core/random.h"
#include "diagnose/statistics/regime/regime_test.h"
#include "diagnose/statistics/series/noise_model.h"

namespace tera {

struct PartiallingOptions {
  RegimeTestOptions test;
  double alpha = 0.01;  ///< family-wise, a step
  std::size_t most = 4;
  int threads = 2;
};

/// One step: the variable that was taken in, and how all of them stood before it was.
struct PartiallingStep {
  std::size_t variable = 0;
  double p_adjusted = 1;
  double share = 0;
  std::vector<RegimeTestResult> tests;  ///< of all variables, in order
};

struct Partialling {
  std::vector<PartiallingStep> steps;
  std::vector<RegimeTestResult> left;  ///< all variables with everything taken in
};

/// Which of several variables explain a residual when the others are already in.
///
/// Model   forward selection: each step tests every variable not in yet given those that are
///         (regime_test.h), adjusts p_tail by Holm over them, and of those at or below alpha takes
///         in the one of the best criterion, the largest share of whitened energy for its size,
///         with twenty splines. Variables whose functions are multiplied are tested
///         given what they are multiplied with: a constant share is no dependence on them.
/// Omits   products of variables; removal of a variable that a later one makes superfluous.
///
/// All series have the residual's length.
Partialling SelectRegimes(const Series& residual, const NoiseModel& noise,
                          const std::vector<RegimeVariable>& variables,
                          const PartiallingOptions& options, const Stream& stream);

/// Splines of the variable, sample by sample: what a design takes as known.
Eigen::MatrixXd KnownColumns(const RegimeAxis& axis);

/// Columns side by side; `known` may have none.
Eigen::MatrixXd WithColumns(const Eigen::MatrixXd& known, const Eigen::MatrixXd& columns);

}  // namespace tera
