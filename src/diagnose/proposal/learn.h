#pragma once

#include "core/random.h"
#include "diagnose/proposal/proposal.h"

namespace tera {

/// Adds to a proposal the effect that a simulation can run, or the reason why there is none.
///
/// Model   candidates in this order: the formula, if it has one variable; the curves over the
///         variable of the error's location and over the proposed one, if a simulation knows them
///         (ReplayBlock::learnable); the best curve over the variables that a simulation knows. A
///         later one replaces an earlier one if its RMSE on SELECT is below nine tenths. Curves are
///         fitted to measured minus predicted. They include what a fit of the whole block assigns
///         to nuisances, such as 2 % of the rate, for a simulation has no nuisances. The comparison
///         uses the replay's response to the effect, including the limits that keep it from moving
///         an axis at rest (learned_rate.h). None where FINAL's RMSE falls by less than a
///         twentieth.
void Learn(const ReplayBlock& block, const BlockDiagnosis& diagnosis, const Stream& stream,
           Proposal* proposal);

}  // namespace tera
