#pragma once

#include <cstddef>
#include <vector>

namespace tera {

struct SignedRank {
  double positive_sum = 0;  ///< of the ranks of positive differences
  std::size_t count = 0;    ///< differences that are not 0
  double p_greater = 1;     ///< of a sum at least so large, with random signs
  double p_less = 1;
  double p_two_sided = 1;
  bool exact = true;
};

/// Wilcoxon's signed-rank test of differences, symmetric about 0 under the hypothesis.
///
/// Model   ranks of |difference|, ties share their mean rank, zeros are left out. Up to 50
///         differences the distribution over all sign assignments of these ranks (ties included) is
///         exact, by counting; beyond, normal with the variance of the tied ranks and continuity
///         correction.
/// Source  Wilcoxon 1945; Hollander and Wolfe, "Nonparametric statistical methods", chapter 3.
SignedRank TestSignedRank(const std::vector<double>& differences);

}  // namespace tera
