#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/random.h"
#include "diagnose/statistics/regime/regime_axis.h"
#include "diagnose/statistics/series/manoeuvres.h"

namespace tera {

/// A curve over one of a channel's variables, tabulated.
struct FittedCurve {
  std::string variable;
  bool is_share = false;  ///< share of the predicted value, not in the channel's unit
  Eigen::VectorXd at, mean, low, high;
};

/// Fits a residual as a curve over one of some variables, or as the prediction times such a curve.
///
/// Model   penalised cubic B-splines (20) by least squares, for each variable, additive and
///         multiplicative. A ridge draws them to 0 where there are no samples. For a lever's
///         direction, one value for each direction. Variable, form and penalty minimise the error
///         over the manoeuvres of TRAIN and SELECT in five-fold cross-validation, and the curve is
///         refitted to all of these. Band: 5 to 95 % of fits to manoeuvres drawn with replacement,
///         pointwise. None without a variable that varies.
/// Omits   dependence on two variables, and terms with memory; the bias of smoothing.
/// Source  Eilers and Marx 1996.
std::optional<FittedCurve> FitCurve(const std::vector<Manoeuvre>& manoeuvres,
                                    const std::vector<RegimeVariable>& variables,
                                    const Series& residual, const std::vector<double>& predicted,
                                    const Stream& stream);

}  // namespace tera
