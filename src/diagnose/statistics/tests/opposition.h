#pragma once

#include <span>

namespace tera {

/// p-value of persistent anticorrelation between two zero-mean series.
///
/// Model   one-sided Student's t over the uncentred correlations of blocks. A block is twice as
///         long as the longer of the two correlation lengths, and has at least ten samples. Blocks
///         in which either series has less than a tenth of its mean power are ignored. p is 1 with
///         fewer than three blocks. For independent zero-mean series the correlations are symmetric
///         and nearly independent between blocks. Their variances may differ: the test is then
///         conservative for p below 0.08.
/// Omits   dependence that outlasts a block; a choice among delays, for which the caller multiplies
///         p.
/// Source  Ibragimov and Mueller 2010, "t-statistic based correlation and heterogeneity robust
///         inference"; Bakirov and Szekely 2006.
double OppositionP(std::span<const double> a, std::span<const double> b);

}  // namespace tera
