#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "diagnose/search/fit/structure_fit.h"

namespace tera {

/// Estimate of a parameter with its standard deviation.
struct ParameterEstimate {
  std::string name, unit;
  double value = 0;
  std::optional<double> sigma;  ///< none if it was held, or the data do not determine it
  /// Standard deviation of the parameter's distance from its neutral value: the library's form errs
  /// in proportion to the effect. For a factor, that is its distance from 1. None where `sigma` is.
  std::optional<double> effect_sigma = {};
};

/// Estimates of one term's parameters. No standard deviation where it would exceed the parameter's
/// range, or where the estimate is at an end of its range. `slides`: the term acts on a prismatic
/// joint, whose radians are metres.
///
/// Model   standard deviations are the larger of that for independent samples and that by the
///         scatter of scores over manoeuvres. For machines and ground, five per cent of the
///         parameter are added in quadrature for errors of the library's form and of nominal
///         numbers. `effect_sigma` gets five per cent of the effect instead.
/// Source  Huber 1967, White 1982 (scores).
std::vector<ParameterEstimate> EstimatesOf(const FittedStructure& found, std::size_t term,
                                           bool slides);

}  // namespace tera
