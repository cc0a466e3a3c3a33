#pragma once

#include <string>
#include <vector>

#include "core/random.h"
#include "diagnose/search/fit/replay_block.h"

namespace tera {

struct NamedMechanism {
  std::string mechanism, target;
};

/// The result of a simpler method, for comparison with the diagnosis.
struct BaselineAnswer {
  std::string method;
  bool gives_findings = false;        ///< the method can report an error
  bool gives_names = false;           ///< the method can name a mechanism
  bool found = false;                 ///< the method reports an error
  std::vector<NamedMechanism> names;  ///< mechanisms in the order of the method's choice
  std::vector<double> rmse_final;     ///< RMSE on FINAL, one per channel
};

/// RMSE of the replay on FINAL, by channel, without candidates and without any fit.
std::vector<double> RmseAsItIs(const ReplayBlock& block, const Stream& stream);

/// Results of five simpler methods, fitted to TRAIN and SELECT. The same `stream` gives the
/// manoeuvres of the diagnosis.
///
/// Model   "static map": a dead time and a static map of the first lever (FitPlainMap).
///         "tuned parameters": least squares on an offset, a gain, a time shift and the channel's
///         nominal columns, without bounds.
///         "greedy BIC": forward selection of candidates by the Bayesian information criterion,
///         with white normal errors.
///         "sparse regression": orthogonal matching pursuit of the residual, stopped by the same
///         criterion. Its library has the regime variables except time, their magnitudes, signs,
///         squares and products.
///         "black box": the residual after the channel's flexible regressor, with the ridge by
///         cross-validation.
/// Omits   coloured and heavy-tailed errors.
/// Source  Schwarz 1978; Brunton, Proctor and Kutz 2016, "Discovering governing equations from data
///         by sparse identification of nonlinear dynamical systems" (library of the sparse
///         regression); Pati, Rezaiifar and Krishnaprasad 1993 (matching pursuit).
std::vector<BaselineAnswer> BaselinesOf(const ReplayBlock& block, int threads,
                                        const Stream& stream);

}  // namespace tera
