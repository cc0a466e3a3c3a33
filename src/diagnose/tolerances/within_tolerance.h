#pragma once

#include <vector>

#include "core/types/tolerance.h"
#include "diagnose/search/block/block_diagnosis.h"

namespace tera {

/// Tells the candidates of blocks what is as expected of their numbers: what the owner `stated` of
/// a target, and else the defaults; and beside either what the levers' log does not tell, which had
/// a row every `lever_interval_s`. A change of a lever is known to half of that: so much more are
/// delays and lags of commands as expected, and twice as much periods of a reader, which are late
/// by half of themselves.
void StateTolerances(const Tolerances& stated, std::vector<ReplayBlock>* blocks,
                     double lever_interval_s = 0);

/// Whether a finding takes as much error from its channel on FINAL as a factor at the end of its
/// tolerance changes there: where what is left with all in its place that is as expected is known,
/// from that, less 1.645 standard deviations for noise.
bool IsOfPracticalSize(const Finding& finding);

/// Whether something that is as expected does as well in a finding's place: a rival with which all
/// is as expected is not rejected, and what the finding takes from the error that is left with all
/// in its place that is as expected is not of practical size. A rival alone does not show it: where
/// it costs much in some manoeuvres and gains in others it leaves error, however steady.
bool IsExplainedAsExpected(const Finding& finding);

/// Whether one of a finding's numbers lies beyond what is as expected, and which that is was
/// determined; and whether the finding is of practical size, and nothing that is as expected does
/// as well in its place.
///
/// Model   a number is beyond its tolerance where 95 % of its posterior, normal about its estimate,
///         lies beyond the nearer end of the tolerance about what the scenario has. A number
///         without a posterior, at a bound of its range or not determined, is beyond nothing. A
///         mechanism of whose free numbers nothing is stated is beyond what is expected if it acts
///         at all.
bool IsBeyondTolerance(const Finding& finding);

/// Whether a finding is not of practical size, or something that is as expected does as well; or
/// it is not beyond tolerance, and its numbers as they are known bear that out: none that is not
/// determined lies beyond.
bool IsWithinTolerance(const Finding& finding);

/// Moves the findings that are within tolerance to their list, and to the unconfirmed ones those of
/// which the recording does not tell. The structure that was found keeps them all: what they
/// explain is not left. From the classes of those that stay goes what is as expected: it does not
/// do as well.
void MoveExpected(BlockDiagnosis* diagnosis);

}  // namespace tera
