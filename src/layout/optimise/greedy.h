#pragma once

#include "layout/optimise/appraisal.h"
#include "layout/optimise/candidate.h"

namespace tera {

/// A layout that is built sensor by sensor. Each round tests `tries` random placements of the free
/// slots and keeps the one that lessens the first objective most. It stops if none improves or the
/// limits allow none; the first sensor is always placed.
///
/// Model   the greedy choice reaches at least 1 - 1/e of the optimum among the tested placements at
///         equal costs, if coverage is a submodular function of the set of sensors.
/// Source  Nemhauser, Wolsey, Fisher 1978, "An analysis of approximations for maximizing submodular
///         set functions", Mathematical Programming 14.
Genes Greedy(const LayoutSearch& search, const Appraisal& appraisal, int tries);

}  // namespace tera
