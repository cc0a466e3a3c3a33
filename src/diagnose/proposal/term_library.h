#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "diagnose/search/fit/replay_block.h"

namespace tera {

/// Functions of one variable in a formula.
enum class FactorForm { kValue, kMagnitude, kSign, kSquare, kSignedSquare, kSine, kCosine };

/// The function's value.
double Shaped(FactorForm form, double x);

/// A function of one variable in a term. `variable` names one of the channel's variables, or is
/// "rate": the model's prediction of the channel itself.
struct Factor {
  std::string variable;
  FactorForm form = FactorForm::kValue;
  bool operator==(const Factor&) const = default;
};

/// A product of one or two factors, with one value for each sample.
struct LibraryTerm {
  std::vector<Factor> factors;
  Eigen::VectorXd column;
};

/// Terms available to a formula for a channel's error.
///
/// Model   every variable except time, and the rate: value, magnitude, sign (of levers and rates),
///         square and signed square; for angles value, sine and cosine. Products: the rate and the
///         first variable (the axis's own lever), each with value, magnitude, sine or cosine of
///         every other variable; the sign of the rate with the load. Almost constant columns are
///         left out, and so are columns proportional to an earlier one. A variable's unit passes to
///         its coefficient, so that no units are mixed.
std::vector<LibraryTerm> TermLibraryOf(const Channel& channel,
                                       const std::vector<double>& predicted);

}  // namespace tera
