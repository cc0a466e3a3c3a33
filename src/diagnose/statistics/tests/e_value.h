#pragma once

#include <vector>

namespace tera {

/// Evidence against a null model from data that the alternative was not fitted to.
///
/// Model   one fold: E = L_alternative(held out; fitted on the rest) / L_null(held out; fitted
///         on the held out itself). Under the null E has mean at most 1 whatever the models, so
///         that P(E >= 1/alpha) <= alpha. Several folds (each held out once): the mean of their
///         E.
/// Source  Wasserman, Ramdas and Balakrishnan 2020, "Universal inference".
struct HeldOutFold {
  double alternative_log_likelihood = 0;
  double null_log_likelihood = 0;  ///< maximised over the null on the held-out samples
};

struct EValue {
  double log_e = 0;
  double p = 1;  ///< min(1, 1/E)
};

/// At least one fold.
EValue CombineFolds(const std::vector<HeldOutFold>& folds);

}  // namespace tera
