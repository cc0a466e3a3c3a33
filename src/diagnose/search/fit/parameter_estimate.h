#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "diagnose/search/fit/structure_fit.h"

namespace tera {

/// A number of a mechanism with its standard deviation.
struct ParameterEstimate {
  std::string name, unit;
  double value = 0;
  std::optional<double> sigma;  ///< none where it was not fitted, or the data do not hold it
  /// Of the number's distance from where the mechanism has no effect: the form of the library is
  /// off by a share of what is there, which for a factor is its distance from 1. None as `sigma`.
  std::optional<double> effect_sigma = {};
};

/// The numbers of one term of a fit. A number has no standard deviation where that would be wider
/// than the parameter's range, or where the number is at an end of its range. `slides`: the term is
/// of a joint whose radians are metres.
///
/// Model   standard deviations are the larger of what independent samples give and of what the
///         scatter of scores over manoeuvres gives. For machines and ground five per cent of the
///         number are added in quadrature, by which the form that a mechanism has in the library,
///         and nominal numbers, are off; to that of the effect, five per cent of the effect.
/// Source  Huber 1967, White 1982 (scores).
std::vector<ParameterEstimate> EstimatesOf(const FittedStructure& found, std::size_t term,
                                           bool slides);

}  // namespace tera
