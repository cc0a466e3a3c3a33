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

/// The answer of a simpler method for a block, with which the diagnosis is compared.
struct BaselineAnswer {
  std::string method;
  bool gives_findings = false;        ///< the method can say that something is wrong
  bool gives_names = false;           ///< the method can say which mechanism it is
  bool found = false;                 ///< the method says that something is wrong
  std::vector<NamedMechanism> names;  ///< in the order in which the method chose them
  std::vector<double> rmse_final;     ///< on FINAL, one a channel
};

/// RMSE on FINAL of the replay without any candidate and without a fit, one a channel.
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
/// Omits   that errors are coloured and heavy-tailed.
/// Source  Schwarz 1978; Brunton, Proctor and Kutz 2016, "Discovering governing equations from
///         data by sparse identification of nonlinear dynamical systems" (the third's library);
///         Pati, Rezaiifar and Krishnaprasad 1993 (its pursuit).
std::vector<BaselineAnswer> BaselinesOf(const ReplayBlock& block, int threads,
                                        const Stream& stream);

}  // namespace tera
