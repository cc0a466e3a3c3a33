#pragma once

#include <string>
#include <vector>

#include "core/random.h"
#include "diagnose/search/fit/replay_block.h"

namespace tera {

/// A mechanism and what it acts on.
struct NamedMechanism {
  std::string mechanism, target;
};

/// What a simpler method makes of a block, to hold the diagnosis against.
struct BaselineAnswer {
  std::string method;
  bool gives_findings = false;        ///< it can say that something is wrong
  bool gives_names = false;           ///< and by which mechanism
  bool found = false;                 ///< something is, as it says
  std::vector<NamedMechanism> names;  ///< of a method that names, the first taken first
  std::vector<double> rmse_final;     ///< one a channel: what it leaves of FINAL
};

/// RMSE of FINAL that the replay without any candidate leaves, nothing fitted; one a channel.
std::vector<double> RmseAsItIs(const ReplayBlock& block, const Stream& stream);

/// Answers of four simpler methods, fitted to TRAIN and SELECT of the manoeuvres that the
/// diagnosis itself splits the block into by the same stream.
///
/// Model   "tuned parameters": least squares on an offset, a gain, a shift in time and the
///         channel's nominal columns, however far they may go. "greedy BIC": one candidate more at
///         a time, the one that lowers the Bayesian information criterion most, errors taken as
///         white and normal. "sparse regression": orthogonal matching pursuit of the residual on
///         the regime variables (but for time), their sizes, signs, squares and products, stopped
///         by the same criterion. "black box": the residual less what the channel's flexible
///         regressor follows of it, its ridge by cross-validation.
/// Omits   anything that takes errors for what they are: coloured and heavy-tailed.
/// Source  Schwarz 1978; Brunton, Proctor and Kutz 2016, "Discovering governing equations from
///         data by sparse identification of nonlinear dynamical systems" (the third's library);
///         Pati, Rezaiifar and Krishnaprasad 1993 (its pursuit).
std::vector<BaselineAnswer> BaselinesOf(const ReplayBlock& block, int threads,
                                        const Stream& stream);

}  // namespace tera
