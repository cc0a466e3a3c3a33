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
  std::size_t block = 0;  ///< samples; shifts within blocks of this length, 0 for one block
  double repeats = 1;     ///< samples after which the residual says something new
};

/// A variable made ready to be tested again and again under one noise model.
///
/// Model   ten B-splines in the basis in which both their information under the noise and their
///         roughness are diagonal (Demmler and Reinsch), weighted to five effective degrees of
///         freedom. A constant, times what the functions are multiplied with, is taken out.
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
  ShiftComparison comparison;  ///< statistic: weighted score, mean 5 if the variable says nothing
  double share =
      0;  ///< of the whitened residual's energy that the variable explains, beyond chance
  double criterion = 0;  ///< the same, but at least log(rows) for each direction (Schwarz 1978)
  /// With what a constant times what the functions are multiplied with explains as well.
  double whole_criterion = 0;
};

/// Whether E[residual | variable], given what the design knows, is other than constant. Of a
/// variable whose functions are multiplied the design must know what they are multiplied with.
///
/// Model   score statistic; reference: the same with the variable turned circularly against the
///         residual that remains. Directions of which the known leaves less than 5 % of the
///         information are not judged.
/// Source  Freedman and Lane 1983, "A nonstochastic interpretation of reported significance
///         levels".
RegimeTestResult TestRegime(const RegimeDesign& design, const RegimeProbe& probe,
                            const RegimeTestOptions& options, const Stream& stream);

}  // namespace tera
