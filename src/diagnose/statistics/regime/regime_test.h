#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/random.h"
#include "diagnose/statistics/regime/regime_design.h"
#include "diagnose/statistics/tests/circular_shifts.h"

namespace tera {

struct RegimeTestOptions {
  std::size_t shifts = 200;
  double repeats = 1;  ///< samples between independent errors, beyond the noise model
};

/// A variable, prepared for repeated tests under one noise model.
///
/// Model   ten B-splines, weighted to five effective degrees of freedom. In their basis, the
///         information under the noise and the roughness are both diagonal (Demmler and Reinsch). A
///         constant times the factor is projected out.
class RegimeProbe {
 public:
  RegimeProbe(const RegimeVariable& variable, const WhiteningFilter& filter);

  const std::string& name() const { return name_; }
  const RegimeAxis& axis() const { return axis_; }
  const Eigen::MatrixXd& gram() const { return gram_; }
  /// Rows: bins. Columns: directions of unit information.
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
  ShiftComparison comparison;  ///< p-values of the weighted score statistic
  /// Share of the whitened residual's energy that the variable explains beyond chance.
  double share = 0;
  /// The share minus a penalty of at least log(rows) per direction (Schwarz 1978).
  double criterion = 0;
  /// The criterion of the variable together with a constant times its factor.
  double whole_criterion = 0;
};

/// Tests whether E[residual | variable], given the design's known columns, is constant. A
/// variable's factor must be among the known columns.
///
/// Model   score statistic, compared with its values under circular shifts of the variable against
///         the residual. Directions that keep less than 5 % of their information beyond the known
///         columns are not tested.
/// Source  Freedman and Lane 1983, "A nonstochastic interpretation of reported significance
///         levels".
RegimeTestResult TestRegime(const RegimeDesign& design, const RegimeProbe& probe,
                            const RegimeTestOptions& options, const Stream& stream);

}  // namespace tera
