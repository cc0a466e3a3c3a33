#pragma once

#include <vector>

#include "core/random.h"
#include "diagnose/statistics/regime/regime_test.h"
#include "diagnose/statistics/series/noise_model.h"

namespace tera {

struct PartiallingOptions {
  RegimeTestOptions test;
  double alpha = 0.01;  ///< family-wise, for each step
  std::size_t most = 4;
  int threads = 2;
};

/// One step: the selected variable, and the preceding tests of all variables.
struct PartiallingStep {
  std::size_t variable = 0;
  double p_adjusted = 1;
  double share = 0;
  std::vector<RegimeTestResult> tests;  ///< of all variables, in order
};

struct Partialling {
  std::vector<PartiallingStep> steps;
  std::vector<RegimeTestResult> left;  ///< of all variables, given the selected ones
};

/// Selects the variables that explain a residual, each given the ones selected before it.
///
/// Model   forward selection. Each step tests every remaining variable given the selected ones
///         (regime_test.h), and adjusts p_tail by Holm over them. Among those at or below alpha it
///         selects the one with the best criterion, the largest share of whitened energy for its
///         size, with twenty splines. Variables with a factor are tested given that factor: a
///         constant share is no dependence on the variable.
/// Omits   products of variables; removal of a variable that a later one makes superfluous.
///
/// All series have the residual's length.
Partialling SelectRegimes(const Series& residual, const NoiseModel& noise,
                          const std::vector<RegimeVariable>& variables,
                          const PartiallingOptions& options, const Stream& stream);

/// Splines of a variable, sample by sample, as known columns of a design.
Eigen::MatrixXd KnownColumns(const RegimeAxis& axis);

/// Columns side by side; `known` may have none.
Eigen::MatrixXd WithColumns(const Eigen::MatrixXd& known, const Eigen::MatrixXd& columns);

}  // namespace tera
