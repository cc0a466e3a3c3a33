#pragma once

#include "core/random.h"
#include "diagnose/proposal/proposal.h"

namespace tera {

/// Gives a proposal the effect that a simulation can run in its place, or says why there is none.
///
/// Model   the formula, if it is of one variable; the curve; or the curve that explains most among
///         the variables that a simulation knows (ReplayBlock::learnable). The first of them of
///         which the replay gains a twentieth of FINAL's RMSE. What the replay makes of it is
///         compared, the limits that keep it from turning what stands included (learned_rate.h).
void Learn(const ReplayBlock& block, const BlockDiagnosis& diagnosis, const Stream& stream,
           Proposal* proposal);

}  // namespace tera
