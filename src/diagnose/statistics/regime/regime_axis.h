#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "diagnose/statistics/series/series.h"

namespace tera {

/// A quantity on which the error may depend: a lever, joint angle, rate, slope or time.
struct RegimeVariable {
  std::string name;
  Series series;
  bool angle = false;  ///< true: radians, periodic with 2 pi
  /// Factor on a function of the variable, by sample. With the simulated value as factor, the error
  /// may be a share of that value. Empty: no factor.
  std::vector<double> times = {};
};

/// A variable in bins, and smooth functions over the bins.
///
/// Model   64 equal bins from the 0.2 % to the 99.8 % quantile; outer values fall in the outermost
///         bins. An angle has bins from -pi to pi. A variable with at most 12 values has one bin
///         per value. Gaps are interpolated. Functions are uniform cubic B-splines, cyclic for an
///         angle; a discrete variable has one column per value. Roughness is the sum of squared
///         second differences of coefficients.
/// Source  Eilers and Marx 1996, "Flexible smoothing with B-splines and penalties".
class RegimeAxis {
 public:
  explicit RegimeAxis(const RegimeVariable& variable);

  std::size_t samples() const { return bin_.size(); }
  Eigen::Index bins() const { return centre_.size(); }
  const std::vector<std::uint8_t>& bin() const { return bin_; }
  const Eigen::VectorXd& centre() const { return centre_; }
  const Eigen::VectorXd& count() const { return count_; }
  double width() const { return width_; }
  bool angle() const { return angle_; }
  bool discrete() const { return discrete_; }
  /// The factor on functions of the variable; 1 without a factor.
  const Eigen::VectorXd& times() const { return times_; }
  bool has_times() const { return has_times_; }
  /// The larger of two correlation lengths (robust.h): of the variable, and of its distance from
  /// its mean.
  std::size_t correlation_length() const { return correlation_length_; }

  /// Rows: bins. Columns: `wanted`, or one per value of a discrete variable.
  Eigen::MatrixXd Splines(Eigen::Index wanted) const;
  /// Square matrix over the columns of Splines(wanted).
  Eigen::MatrixXd Roughness(Eigen::Index wanted) const;

 private:
  Eigen::VectorXd centre_, count_, times_;
  std::vector<std::uint8_t> bin_;
  double width_ = 0;
  bool angle_ = false, discrete_ = false, has_times_ = false;
  std::size_t correlation_length_ = 1;
};

/// Sum over each bin of `value` times the factor.
Eigen::VectorXd SumByBin(const RegimeAxis& axis, const Eigen::VectorXd& value);

}  // namespace tera
