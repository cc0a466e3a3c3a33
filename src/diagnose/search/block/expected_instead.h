#pragma once

#include <cstddef>

#include "diagnose/search/fit/structure_fit.h"

namespace tera {

/// The misfit where parameters within tolerance (delays, lags, bands, gains of its target) replace
/// one term of a structure.
///
/// Model   forward selection of at most three other mechanisms of the term's target that have a
///         stated tolerance. Their parameters stay within tolerance, or at their defaults where
///         none is stated. The rest of the structure is fitted anew. A mechanism is added while the
///         log-likelihood rises by more than one for each parameter.
///         Delays of a target's commands share one tolerance (MayJoin).
/// Omits   that several other parameters at the ends of their tolerances are less likely together
///         than one.
Misfit MisfitOfExpectedInstead(const ReplayBlock& block, const StructureFitter& fitter,
                               const Structure& found, std::size_t term);

/// MisfitOfExpectedInstead with all terms kept. Candidates are the mechanisms of every target.
Misfit MisfitOfExpectedBeside(const ReplayBlock& block, const StructureFitter& fitter,
                              const FittedStructure& found);

}  // namespace tera
