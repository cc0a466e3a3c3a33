#pragma once

#include <functional>
#include <optional>

#include "core/random.h"
#include "diagnose/proposal/proposal.h"
#include "diagnose/statistics/regime/regime_axis.h"

namespace tera {

/// What a curve is to explain, and by what.
struct CurveProblem {
  std::size_t channel = 0;
  const std::vector<Manoeuvre>& manoeuvres;
  const std::vector<RegimeVariable>& variables;
  const Series& residual;
  const std::vector<double>& predicted;  ///< of the channel, which the curve may be a share of
  /// Whether a curve may be over a variable.
  std::function<bool(const RegimeVariable&)> may_depend = [](const RegimeVariable&) {
    return true;
  };
};

/// A curve over one variable that explains what is left of a channel, if one is found that holds.
/// It is added to the prediction, or multiplied with the prediction and added.
///
/// Model   penalised cubic B-splines (20) by least squares, for each of the variables, added and
///         multiplied, with a ridge that draws them to 0 where nothing was seen; of a lever's way a
///         value for each. The variable, the way and the penalty are those that leave least of the
///         manoeuvres of TRAIN and SELECT, each fifth predicted by the others; they are then fitted
///         to all of these. Band: 5 to 95 % of fits to manoeuvres drawn with replacement, at each
///         place. None where FINAL gains less than a twentieth.
/// Omits   dependence on two variables, and terms with memory; the bias of smoothing.
/// Source  Eilers and Marx 1996.
std::optional<Proposal> ProposeCurve(const CurveProblem& problem, const Stream& stream);

}  // namespace tera
