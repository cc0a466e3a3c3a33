#pragma once

#include <optional>

#include "core/random.h"
#include "diagnose/proposal/proposal.h"

namespace tera {

/// The curve over one variable for what is left of a channel, if one is found that holds: added to
/// the prediction, or multiplied with it and added.
///
/// Model   penalised cubic B-splines (20) by least squares, of each of the channel's variables,
///         both ways: the variable, the way and the penalty that, fitted to TRAIN, leave least of
///         SELECT, fitted anew to both. Band: 5 to 95 % of fits to manoeuvres drawn with
///         replacement, at each place. Nothing where FINAL does not gain a twentieth.
/// Omits   dependence on two variables, and terms with memory; the bias of smoothing.
/// Source  Eilers and Marx 1996.
std::optional<Proposal> ProposeCurve(const ReplayBlock& block, const BlockDiagnosis& diagnosis,
                                     std::size_t channel, const Stream& stream);

}  // namespace tera
