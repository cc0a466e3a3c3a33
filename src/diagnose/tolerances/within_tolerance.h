#pragma once

#include <vector>

#include "core/types/tolerance.h"
#include "diagnose/search/block/block_diagnosis.h"

namespace tera {

/// Sets the expected deviations of all candidates' parameters: the owner's `stated` ones, else the
/// defaults. Both are widened by the resolution of the levers' log, with rows at intervals of
/// `lever_interval_s`. A lever's change is known to half an interval, and delays and lags of
/// commands are widened by that. Periods of a reader, whose mean delay is half a period, are
/// widened by twice as much.
void StateTolerances(const Tolerances& stated, std::vector<ReplayBlock>* blocks,
                     double lever_interval_s = 0);

/// Whether a finding removes at least as much of its channel's error on FINAL as a factor at the
/// end of its tolerance causes. Where known, the error before is that of the best model with all
/// parameters within tolerance in the finding's place, less 1.645 standard deviations for noise.
bool IsOfPracticalSize(const Finding& finding);

/// Whether a hypothesis within tolerance explains as well in the finding's place. A rival within
/// tolerance must not be rejected, and the finding's improvement over the best model within
/// tolerance must not be of practical size. The rival alone is no proof: it may lose much in some
/// manoeuvres and gain in others, and still leave error.
bool IsExplainedAsExpected(const Finding& finding);

/// Whether one of a finding's parameters is significantly beyond tolerance. The finding must also
/// be of practical size, and no hypothesis within tolerance may explain as well.
///
/// Model   a parameter is beyond its tolerance if 95 % of its posterior lies beyond the nearer end.
///         The posterior is normal about the estimate, the tolerance about the scenario's value. A
///         parameter has no posterior if it is at a bound of its range or undetermined; it then
///         never counts as beyond tolerance. A mechanism whose free parameters all lack a stated
///         tolerance is beyond it if it acts at all.
bool IsBeyondTolerance(const Finding& finding);

/// Whether a finding is not of practical size, or a hypothesis within tolerance explains as well.
/// Otherwise whether it is not beyond tolerance, and its undetermined parameters lie within theirs.
bool IsWithinTolerance(const Finding& finding);

/// Moves findings within tolerance to their list, and findings that the recording cannot decide to
/// the unconfirmed ones. The fitted structure keeps them all, so that the residual excludes them.
/// Removes rivals within tolerance from the classes of the remaining findings, since they do not
/// explain as well.
void MoveExpected(BlockDiagnosis* diagnosis);

}  // namespace tera
