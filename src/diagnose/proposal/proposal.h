#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/random.h"
#include "core/types/learned_effect.h"
#include "diagnose/search/block/block_diagnosis.h"
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

/// Normal equations of a fit, which add up over manoeuvres.
struct LeastSquares {
  Eigen::MatrixXd information;
  Eigen::VectorXd pull;
  double energy = 0, rows = 0;  ///< of the fitted values: sum of squares, samples

  void Add(const LeastSquares& other, double times = 1);
};

/// A term of a formula with its coefficient, in SI units.
struct ProposedTerm {
  std::vector<Factor> factors;
  double coefficient = 0, sigma = 0;
  double stability = 0;  ///< share of random halves of the manoeuvres that select it or an
                         ///< equivalent term
};

/// A curve over one of the channel's variables, tabulated.
struct ProposedCurve {
  std::string variable;
  bool is_share = false;  ///< share of the predicted value, not in the channel's unit
  Eigen::VectorXd at, mean, low, high;
};

/// A proposal as an effect that a simulation can run, and its result in the replay.
struct LearnedProposal {
  LearnedEffect effect;
  double rmse_before = 0, rmse_after = 0;  ///< on FINAL, which no fit used
};

/// A formula or curve to add to the prediction where no mechanism explains the error. It describes
/// the error without naming its cause.
struct Proposal {
  std::size_t channel = 0;
  std::vector<ProposedTerm> terms;  ///< of a formula, by descending weight
  std::optional<ProposedCurve> curve;
  // For a formula, offset, gain, delay and nominal numbers are refitted before the RMSE is
  // computed. For a curve they are not.
  double rmse_select = 0;                  ///< on SELECT, fitted to TRAIN alone
  double rmse_before = 0, rmse_after = 0;  ///< on FINAL, which no fit used
  std::optional<LearnedProposal> learned = {};
  std::string not_learned = {};  ///< reason if there is none
};

/// RMS of the valid samples of a mask.
double RmsOver(const Series& series, const Mask& mask);

/// True if a proposal reduces the RMSE on FINAL by at least a twentieth.
bool Holds(double rmse_before, double rmse_after);

}  // namespace tera
