#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/random.h"
#include "diagnose/proposal/term_library.h"
#include "diagnose/search/block/block_diagnosis.h"

namespace tera {

/// A term of a formula with its number, in SI units.
struct ProposedTerm {
  std::vector<Factor> factors;
  double coefficient = 0, sigma = 0;
  double stability = 0;  ///< share of subsamples of the manoeuvres that choose it, or one alike
};

/// A curve over one of the channel's variables, at places of it.
struct ProposedCurve {
  std::string variable;
  bool is_share = false;  ///< of the predicted value, not in the channel's unit
  Eigen::VectorXd at, mean, low, high;
};

/// What should be added to the prediction where no mechanism explains the error: a formula or a
/// curve. A proposal, no name: it says of what the error is made, not why.
struct Proposal {
  std::size_t channel = 0;
  std::vector<ProposedTerm> terms;  ///< of a formula, the weightiest first
  std::optional<ProposedCurve> curve;
  /// Of a formula beside offset, gain, delay and nominal numbers fitted anew, of a curve alone.
  double rmse_select = 0;                  ///< on SELECT, of its numbers as TRAIN has them
  double rmse_before = 0, rmse_after = 0;  ///< on FINAL, of which nothing was used
};

/// RMS of what is valid in a mask.
double RmsOver(const Series& series, const Mask& mask);

/// Whether FINAL gains a twentieth of its RMSE.
bool Holds(const Proposal& proposal);

/// What is proposed for what is left of a channel, if anything holds: a formula, unless a curve
/// leaves less than nine tenths as much of SELECT.
std::optional<Proposal> Propose(const ReplayBlock& block, const BlockDiagnosis& diagnosis,
                                std::size_t channel, const Stream& stream);

}  // namespace tera
