#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/random.h"
#include "diagnose/statistics/hypothesis_tests/circular_shifts.h"
#include "diagnose/statistics/regime/regime_design.h"

namespace tera {

struct RegimeTestOptions {
  std::size_t shifts = 200;
  double repeats = 1;  ///< correlation length of the residual beyond the noise model, in samples
};

/// A variable, prepared to be tested repeatedly under one noise model.
///
/// Model   ten B-splines, weighted to five effective degrees of freedom. In their basis, both
///         information under the noise and roughness are diagonal (Demmler and Reinsch). A
///         constant, times the axis's factor, is projected out.
class RegimeProbe {
 public:
  RegimeProbe(const RegimeVariable& variable, const WhiteningFilter& filter);

  const std::string& name() const { return name_; }
  const RegimeAxis& axis() const { return axis_; }
  const Eigen::MatrixXd& gram() const { return gram_; }
  /// bins x directions, each of unit information.
  const Eigen::MatrixXd& directions() const { return directions_; }
  const Eigen::VectorXd& weights() const { return weights_; }

 private:
  std::string name_;
  RegimeAxis axis_;
  Eigen::MatrixXd gram_, directions_;
  Eigen::VectorXd weights_;
};

struct RegimeTestResult {
  std::string name;
  ShiftComparison comparison;  ///< of the weighted score
  /// Share of the whitened residual's energy that the variable explains beyond chance.
  double share = 0;
  /// The share minus a penalty of at least log(rows) for each direction (Schwarz 1978).
  double criterion = 0;
  /// The criterion of the variable together with a constant times the axis's factor.
  double whole_criterion = 0;
};

/// Tests whether E[residual | variable], given the design's known columns, is not constant. The
/// design must know the factor of a variable that has one.
///
/// Model   score statistic; the reference is the statistic with the variable shifted circularly
///         against the residual. Directions that keep less than 5 % of their information beyond the
///         known columns are not tested.
/// Source  Freedman and Lane 1983, "A nonstochastic interpretation of reported significance
///         levels".
RegimeTestResult TestRegime(const RegimeDesign& design, const RegimeProbe& probe,
                            const RegimeTestOptions& options, const Stream& stream);

}  // namespace tera
