#pragma once

#include <vector>

#include "core/types/tolerance.h"
#include "diagnose/search/block/block_diagnosis.h"

namespace tera {

/// Sets the expected deviations of all candidates' parameters: the owner's `stated` ones, else the
/// defaults. The resolution of a lever log with rows at intervals of `lever_interval_s` widens some
/// of them. Delays and lags of commands widen by half the interval. The period of an input reader,
/// whose mean delay is half the period, widens by the interval.
void StateTolerances(const Tolerances& stated, std::vector<ReplayBlock>* blocks,
                     double lever_interval_s = 0);

/// True if a finding reduces its channel's error on FINAL by at least the error that a rate factor
/// at the end of its tolerance causes (Finding::tolerated). If `as_expected` is set and has a
/// smaller error than the model without the finding, the reduction is measured from that error,
/// minus 1.645 standard deviations due to noise.
bool IsOfPracticalSize(const Finding& finding);

/// True if a hypothesis within tolerance explains the data as well as the finding. Two conditions
/// hold: a rival within tolerance is not rejected, and the finding's improvement over the best
/// model within tolerance is not of practical size. The rival alone is no proof: it may lose much
/// in some manoeuvres, gain in others, and still leave error.
bool IsExplainedAsExpected(const Finding& finding);

/// True if a finding is beyond tolerance. Three conditions hold: at least one parameter is
/// significantly beyond tolerance, the finding is of practical size, and no hypothesis within
/// tolerance explains the data as well.
///
/// Model   a parameter is beyond tolerance if 95 % of its posterior lies beyond the nearer end. The
///         posterior is normal about the estimate; the tolerance is centred on the scenario's
///         value. A parameter at a bound of its range, or an undetermined one, has no posterior and
///         never counts as beyond. A mechanism without stated tolerances is beyond tolerance if it
///         acts at all.
bool IsBeyondTolerance(const Finding& finding);

/// True in each of three cases. The finding is not of practical size. A hypothesis within tolerance
/// explains the data as well. The finding is not beyond tolerance, and its undetermined parameters
/// lie within their tolerances.
bool IsWithinTolerance(const Finding& finding);

/// Moves findings within tolerance to their list, and undecided findings to the unconfirmed ones.
/// All stay in the fitted structure, so that residuals do not contain their effects. Removes rivals
/// within tolerance from the remaining findings, because these rivals do not explain the data as
/// well.
void MoveExpected(BlockDiagnosis* diagnosis);

}  // namespace tera
