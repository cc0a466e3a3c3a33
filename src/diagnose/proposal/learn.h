#pragma once

#include "core/random.h"
#include "diagnose/proposal/proposal.h"

namespace tera {

/// Gives a proposal the effect that a simulation can run in its place, or says why there is none.
///
/// Model   the formula, if it is of one variable; the curves over the variable that the error was
///         located by and over the proposed one, if a simulation knows them
///         (ReplayBlock::learnable); the curve that explains most among those over what it knows.
///         Each is taken in the place of one before it where it leaves less than nine tenths as
///         much of SELECT. Curves are fitted to measured less predicted: what a fit of the whole
///         block takes for nuisances, such as 2 % of the rate, is in it, for a simulation has none.
///         What the replay makes of the effect is compared, the limits included that keep it from
///         turning what stands (learned_rate.h). None where FINAL gains less than a twentieth.
void Learn(const ReplayBlock& block, const BlockDiagnosis& diagnosis, const Stream& stream,
           Proposal* proposal);

}  // namespace tera
