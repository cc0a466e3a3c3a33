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
  // RMSE of a formula include refitted offset, gain, delay and nominal numbers; those of a curve do
  // not.
  double rmse_select = 0;                  ///< on SELECT, fitted to TRAIN alone
  double rmse_before = 0, rmse_after = 0;  ///< on FINAL, which no fit used
  std::optional<LearnedProposal> learned = {};
  std::string not_learned = {};  ///< reason if there is none
};

/// RMS of the valid samples of a mask.
double RmsOver(const Series& series, const Mask& mask);

/// Whether a proposal removes a twentieth of FINAL's RMSE.
bool Holds(double rmse_before, double rmse_after);

}  // namespace tera
