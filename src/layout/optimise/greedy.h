#pragma once

#include "layout/optimise/appraisal.h"
#include "layout/optimise/candidate.h"

namespace tera {

/// A layout that is put together sensor by sensor: each time the one of `tries` random placements
/// of a slot that is still free which lessens the first objective most, as long as one does and
/// the limits allow it; the first sensor in any case.
///
/// Model   where what is seen is a submodular function of the set of sensors, as coverage is, the
///         greedy choice reaches 1 - 1/e of the best at least, among the placements that were
///         tried, if all cost alike.
/// Source  Nemhauser, Wolsey, Fisher 1978, "An analysis of approximations for maximizing submodular
///         set functions", Mathematical Programming 14.
Genes Greedy(const LayoutSearch& search, const Appraisal& appraisal, int tries);

}  // namespace tera
