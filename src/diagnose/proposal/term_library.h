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
/// "rate": what the model predicts of the channel itself.
struct Factor {
  std::string variable;
  FactorForm form = FactorForm::kValue;
  bool operator==(const Factor&) const = default;
};

/// A product of one or two factors, and its values, a row a sample.
struct LibraryTerm {
  std::vector<Factor> factors;
  Eigen::VectorXd column;
};

/// The terms that a formula for a channel's error may have.
///
/// Model   every variable but time, and the rate: its value, magnitude, sign (of levers and rates),
///         square and signed square; of angles value, sine and cosine instead. Products: the rate
///         and the first variable (the own lever) each with value, magnitude, sine or cosine of
///         every other; the sign of the rate with the load. Columns that hardly change, and those
///         alike to an earlier one but for a factor, are left out. What has a unit passes it on to
///         its coefficient: none is ever added to another.
std::vector<LibraryTerm> TermLibraryOf(const Channel& channel,
                                       const std::vector<double>& predicted);

}  // namespace tera
