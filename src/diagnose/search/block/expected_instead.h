#pragma once

#include <cstddef>

#include "diagnose/search/fit/structure_fit.h"

namespace tera {

/// The misfit where mechanisms within tolerance replace one term of a structure.
///
/// Model   forward selection of at most three other mechanisms of the term's target that have a
///         stated tolerance. Parameters with a stated tolerance stay within it; the others keep
///         their defaults. The rest of the structure is refitted. A mechanism is added while the
///         log-likelihood rises by more than 1 per parameter.
///         Delays of one target's commands share one tolerance (HeldBeside).
/// Omits   that several other parameters at the ends of their tolerances are less likely together
///         than one.
Misfit MisfitOfExpectedInstead(const ReplayBlock& block, const StructureFitter& fitter,
                               const Structure& found, std::size_t term);

/// Like MisfitOfExpectedInstead, but all terms stay, and mechanisms of every target are added.
Misfit MisfitOfExpectedBeside(const ReplayBlock& block, const StructureFitter& fitter,
                              const FittedStructure& found);

}  // namespace tera
