#pragma once

#include <optional>

#include "core/random.h"
#include "diagnose/proposal/proposal.h"

namespace tera {

/// A short formula that explains what is left of a channel, if one is found that holds.
///
/// Model   orthogonal matching pursuit of the whitened residual on the term library
///         (term_library.h), beside offset, gain, delay and nominal numbers, on TRAIN and SELECT;
///         at most three terms, each by the extended Bayesian information criterion. Stability: the
///         same on 60 random halves of the manoeuvres; seven of ten must choose a term, or one that
///         correlates with it by 0.95. The terms that stay are fitted anew, with standard
///         deviations by the scatter over manoeuvres. None where FINAL gains less than a twentieth.
/// Omits   terms with memory; a dependence that the library has not.
/// Source  Pati, Rezaiifar, Krishnaprasad 1993; Meinshausen and Buehlmann 2010, "Stability
///         selection"; Chen and Chen 2008 (the criterion); Brunton, Proctor, Kutz 2016 (sparse
///         regression on a library).
std::optional<Proposal> ProposeFormula(const ReplayBlock& block, const BlockDiagnosis& diagnosis,
                                       std::size_t channel, const Stream& stream);

}  // namespace tera
