#pragma once

#include <optional>

#include "core/random.h"
#include "diagnose/proposal/proposal.h"

namespace tera {

/// A short formula that explains a channel's residual, if one generalises.
///
/// Model   orthogonal matching pursuit of the whitened residual on the term library
///         (term_library.h), jointly with offset, gain, delay and nominal numbers, on TRAIN and
///         SELECT. At most three terms, each accepted by the extended Bayesian information
///         criterion. Stability: the selection is repeated on 60 random halves of the manoeuvres.
///         Seven of ten must select a term, or one whose correlation with it is 0.95. The remaining
///         terms are refitted, with standard deviations from the scatter over manoeuvres. None
///         where FINAL's RMSE falls by less than a twentieth.
/// Omits   terms with memory; dependences outside the library.
/// Source  Pati, Rezaiifar, Krishnaprasad 1993; Meinshausen and Buehlmann 2010, "Stability
///         selection"; Chen and Chen 2008 (the criterion); Brunton, Proctor, Kutz 2016 (sparse
///         regression on a library).
std::optional<Proposal> ProposeFormula(const ReplayBlock& block, const BlockDiagnosis& diagnosis,
                                       std::size_t channel, const Stream& stream);

}  // namespace tera
