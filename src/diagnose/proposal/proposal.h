#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/random.h"
#include "core/types/learned_effect.h"
#include "diagnose/proposal/term_library.h"
#include "diagnose/search/block/block_diagnosis.h"

namespace tera {

/// A term of a formula with its number, in SI units.
struct ProposedTerm {
  std::vector<Factor> factors;
  double coefficient = 0, sigma = 0;
  double stability = 0;  ///< share of random halves of the manoeuvres that choose it, or one alike
};

/// A curve over one of the channel's variables, tabulated.
struct ProposedCurve {
  std::string variable;
  bool is_share =
      false;  ///< the curve is a share of the predicted value, not in the channel's unit
  Eigen::VectorXd at, mean, low, high;
};

/// A proposal as an effect that a simulation runs, and what it does to the replay.
struct LearnedProposal {
  LearnedEffect effect;
  double rmse_before = 0, rmse_after = 0;  ///< on FINAL, to which nothing was fitted
};

/// A formula or curve that should be added to the prediction where no mechanism explains the error.
/// It is a proposal and no name: it describes the error, not its cause.
struct Proposal {
  std::size_t channel = 0;
  std::vector<ProposedTerm> terms;  ///< of a formula, the weightiest first
  std::optional<ProposedCurve> curve;
  // RMSE of a formula are beside offset, gain, delay and nominal numbers, fitted anew; those of a
  // curve are without.
  double rmse_select = 0;                  ///< on SELECT, fitted to TRAIN alone
  double rmse_before = 0, rmse_after = 0;  ///< on FINAL, to which nothing was fitted
  std::optional<LearnedProposal> learned = {};
  std::string not_learned = {};  ///< why there is none
};

/// RMS of the valid samples of a mask.
double RmsOver(const Series& series, const Mask& mask);

/// Whether a proposal removes a twentieth of FINAL's RMSE.
bool Holds(double rmse_before, double rmse_after);

}  // namespace tera
