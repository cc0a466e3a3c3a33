#pragma once

#include <vector>

#include "core/random.h"
#include "diagnose/statistics/regime/regime_test.h"
#include "diagnose/statistics/series/noise_model.h"

namespace tera {

struct PartiallingOptions {
  RegimeTestOptions test;
  double alpha = 0.01;  ///< family-wise, in each step
  std::size_t most = 4;
  int threads = 2;
};

/// One selected variable, and the tests of all variables from which it was selected.
struct PartiallingStep {
  std::size_t variable = 0;
  double p_adjusted = 1;
  double share = 0;
  std::vector<RegimeTestResult> tests;  ///< one per variable
};

struct Partialling {
  std::vector<PartiallingStep> steps;
  std::vector<RegimeTestResult> left;  ///< one per variable, given the selected ones
};

/// Selects the variables that explain a residual, each given those selected before.
///
/// Model   forward selection. Each step tests every remaining variable given the selected ones
///         (regime_test.h), and corrects p_tail over them (Holm). Among variables with p up to
///         alpha, the one with the best criterion is selected: the largest share of whitened
///         energy, penalised for its number of columns, with twenty splines. A variable with a
///         factor is tested given that factor, because a constant share does not depend on the
///         variable.
/// Omits   products of variables; removal of a variable that a later one makes superfluous.
///
/// All series have the residual's length.
Partialling SelectRegimes(const Series& residual, const NoiseModel& noise,
                          const std::vector<RegimeVariable>& variables,
                          const PartiallingOptions& options, const Stream& stream);

/// Splines of a variable at each sample, as known columns of a design.
Eigen::MatrixXd KnownColumns(const RegimeAxis& axis);

/// Columns side by side. `known` may be empty.
Eigen::MatrixXd WithColumns(const Eigen::MatrixXd& known, const Eigen::MatrixXd& columns);

}  // namespace tera
