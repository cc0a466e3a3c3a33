#pragma once

#include <cstddef>

#include "diagnose/search/fit/structure_fit.h"

namespace tera {

/// What is left of a block's channels where one term of a structure gives way to what is as
/// expected of its target: delays, lags, bands and gains, each no further off than its tolerance.
///
/// Model   every other mechanism of the term's target of which something is stated, its numbers
///         within what is as expected and the others at their defaults, is tried beside the rest of
///         the structure, whose numbers are fitted anew; the likeliest is kept, and again beside
///         it, three at most, while the likelihood gains more than one for each number.
/// Omits   that several numbers at the ends of their tolerances at once are rarer than one.
Misfit MisfitOfExpectedInstead(const ReplayBlock& block, const StructureFitter& fitter,
                               const Structure& found, std::size_t term);

}  // namespace tera
