#pragma once

#include <functional>
#include <optional>

#include "core/random.h"
#include "diagnose/proposal/proposal.h"
#include "diagnose/statistics/regime/regime_axis.h"

namespace tera {

/// Residual to explain, and the variables to explain it by.
struct CurveProblem {
  std::size_t channel = 0;
  const std::vector<Manoeuvre>& manoeuvres;
  const std::vector<RegimeVariable>& variables;
  const Series& residual;
  const std::vector<double>& predicted;  ///< prediction of the channel, of which the curve may be a
                                         ///< share
  /// Whether a curve may depend on a variable.
  std::function<bool(const RegimeVariable&)> may_depend = [](const RegimeVariable&) {
    return true;
  };
};

/// Proposes a curve over one variable that explains a channel's residual. The curve, or its product
/// with the prediction, is added to the prediction. Empty if no curve predicts manoeuvres outside
/// its fit.
///
/// Model   penalised cubic B-splines (20) by least squares, for each variable, additive and
///         multiplicative. A ridge penalty pulls the curve to 0 where there are no samples. For a
///         lever's direction, one value for each direction. Variable, form and penalty minimise the
///         error over the manoeuvres of TRAIN and SELECT in five-fold cross-validation, and the
///         curve is refitted to all of these. Band: 5 to 95 % of fits to manoeuvres drawn with
///         replacement, pointwise. Empty if it reduces the RMSE on FINAL by less than a twentieth.
/// Omits   dependence on two variables, and terms with memory; the bias of smoothing.
/// Source  Eilers and Marx 1996.
std::optional<Proposal> ProposeCurve(const CurveProblem& problem, const Stream& stream);

}  // namespace tera
