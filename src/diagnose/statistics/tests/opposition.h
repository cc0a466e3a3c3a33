#pragma once

#include <span>

namespace tera {

/// The p-value of two series about zero going against each other as steadily by chance.
///
/// Model   blocks twice as long as the longer of the two correlation lengths, ten samples at least;
///         one number a block, the correlation about zero within it; those count in which both
///         series have a tenth of their mean power. One-sided Student's t, with fewer than three
///         blocks p is 1. For series that are independent of each other and about zero the numbers
///         are symmetric, and nearly independent from block to block; they may differ in their
///         variance, for which the test is conservative at p below 0.08.
/// Omits   dependence that outlasts a block; a choice among delays, for which a caller multiplies.
/// Source  Ibragimov and Mueller 2010, "t-statistic based correlation and heterogeneity robust
///         inference"; Bakirov and Szekely 2006.
double OppositionP(std::span<const double> a, std::span<const double> b);

}  // namespace tera
