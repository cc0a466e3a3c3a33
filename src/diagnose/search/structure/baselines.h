#pragma once

#include <string>
#include <vector>

#include "core/random.h"
#include "diagnose/search/fit/replay_block.h"

namespace tera {

/// A mechanism and its target.
struct NamedMechanism {
  std::string mechanism, target;
};

/// A simpler method's result for a block, with which the diagnosis is compared.
struct BaselineAnswer {
  std::string method;
  bool gives_findings = false;        ///< the method can detect an error
  bool gives_names = false;           ///< the method can name the mechanism
  bool found = false;                 ///< the method detects an error
  std::vector<NamedMechanism> names;  ///< in the order of the method's choice
  std::vector<double> rmse_final;     ///< on FINAL, one a channel
};

/// RMSE on FINAL of the replay without candidates and without a fit, one a channel.
std::vector<double> RmseAsItIs(const ReplayBlock& block, const Stream& stream);

/// Results of four simpler methods, fitted to TRAIN and SELECT. The manoeuvres are those of the
/// diagnosis, by the same stream.
///
/// Model   "tuned parameters": least squares on an offset, a gain, a time shift and the channel's
///         nominal columns, without bounds.
///         "greedy BIC": forward selection of candidates by the Bayesian information criterion,
///         with white normal errors.
///         "sparse regression": orthogonal matching pursuit of the residual on the regime variables
///         (except time), their magnitudes, signs, squares and products, stopped by the same
///         criterion.
///         "black box": the residual after the channel's flexible regressor, with the ridge by
///         cross-validation.
/// Omits   that errors are coloured and heavy-tailed.
/// Source  Schwarz 1978; Brunton, Proctor and Kutz 2016, "Discovering governing equations from data
///         by sparse identification of nonlinear dynamical systems" (the third's library); Pati,
///         Rezaiifar and Krishnaprasad 1993 (its pursuit).
std::vector<BaselineAnswer> BaselinesOf(const ReplayBlock& block, int threads,
                                        const Stream& stream);

}  // namespace tera
