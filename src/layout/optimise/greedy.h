#pragma once

#include "layout/optimise/appraisal.h"
#include "layout/optimise/candidate.h"

namespace tera {

/// Builds a layout sensor by sensor. Each round tests `tries` random placements for every free slot
/// and keeps the placement with the lowest first objective. It stops if no placement improves the
/// objective or the limits allow none. The first round accepts any allowed placement.
///
/// Model   a bound holds if the sensors have equal cost and coverage is a submodular function of
///         the set of sensors. The result then reaches at least 1 - 1/e of the best coverage among
///         the tested placements.
/// Source  Nemhauser, Wolsey, Fisher 1978, "An analysis of approximations for maximizing submodular
///         set functions", Mathematical Programming 14.
Genes Greedy(const LayoutSearch& search, const Appraisal& appraisal, int tries);

}  // namespace tera
