#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "diagnose/search/fit/structure_fit.h"

namespace tera {

struct ParameterEstimate {
  std::string name, unit;
  double value = 0;
  std::optional<double> sigma;  ///< empty if held, or if the data do not determine it
  /// Standard deviation of the effect: the parameter's distance from its neutral value (1 for a
  /// factor). The form of a mechanism errs in proportion to this effect. Empty if `sigma` is empty.
  std::optional<double> effect_sigma = {};
};

/// Estimates of a term's parameters. `sigma` is empty if it would exceed the parameter's range, or
/// if the estimate is at an end of the range. `slides`: the term acts on a prismatic joint, where
/// rad reads as m.
///
/// Model   the standard deviation is the larger of two: for independent samples, and by the scatter
///         of scores over manoeuvres. Mechanisms of machines and ground have an imperfect form and
///         nominal numbers: 5 % of the parameter are added in quadrature, in `effect_sigma` 5 % of
///         the effect.
/// Source  Huber 1967, White 1982 (scores).
std::vector<ParameterEstimate> EstimatesOf(const FittedStructure& found, std::size_t term,
                                           bool slides);

}  // namespace tera
