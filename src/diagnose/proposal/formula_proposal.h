#pragma once

#include <optional>

#include "core/random.h"
#include "diagnose/proposal/proposal.h"

namespace tera {

/// The formula for what is left of a channel, if a short one is found that holds.
///
/// Model   orthogonal matching pursuit of the whitened residual on the term library
///         (term_library.h), beside offset, gain, delay and nominal numbers, on TRAIN and SELECT;
///         at most three terms, each by the extended Bayesian information criterion. Stability: the
///         same on 60 random halves of the manoeuvres; a term must be chosen in seven of ten of
///         them, or one that correlates with it by 0.95. What stays is fitted anew; standard
///         deviations by the scatter over manoeuvres. Nothing where FINAL does not gain a
///         twentieth.
/// Omits   terms with memory; a dependence that the library has not.
/// Source  Pati, Rezaiifar, Krishnaprasad 1993; Meinshausen and Buehlmann 2010, "Stability
///         selection"; Chen and Chen 2008 (the criterion); Brunton, Proctor, Kutz 2016 (sparse
///         regression on a library).
std::optional<Proposal> ProposeFormula(const ReplayBlock& block, const BlockDiagnosis& diagnosis,
                                       std::size_t channel, const Stream& stream);

}  // namespace tera
