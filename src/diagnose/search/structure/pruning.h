#pragma once

#include <cstddef>
#include <vector>

#include "diagnose/search/fit/cross_fit.h"
#include "diagnose/search/fit/scored_fits.h"
#include "diagnose/search/fit/steady_gain.h"
#include "diagnose/search/structure/search_result.h"
#include "diagnose/statistics/series/manoeuvres.h"

namespace tera {

/// A structure in which every term is needed.
struct PrunedStructure {
  Scored structure;
  Misfit crossed;                      ///< cross-fitted misfit (cross_fit.h)
  std::vector<TermEvidence> evidence;  ///< one per term, without rivals
};

/// Removes terms that a structure does not need.
///
/// Model   backward elimination: the least needed term is removed until all remaining terms are
///         needed (criteria in StructureSearch). One exception concerns pairs of terms that are
///         needed only together, for example play in a joint that pulls harder than it pushes. If
///         exactly one term would leave, and exactly one other would then leave too, both are
///         tested together against the rest. The p-value is corrected for the number of pairs of
///         candidates.
/// Omits   selection of the pair by the same manoeuvres, beyond the number of tests; pairs whose
///         two terms both seem unneeded alone. FINAL judges each of the two terms separately.
class Pruning {
 public:
  /// `likelihood`, `fitter` and `fits` use TRAIN. All references must outlive this object.
  /// `of_prefix`: the structure comes from a prefix of the block; fits of smaller structures then
  /// start only from its values.
  Pruning(const ReplayBlock& block, const std::vector<NoiseModel>& noise,
          const std::vector<Manoeuvre>& manoeuvres, const Likelihood& likelihood,
          const StructureFitter& fitter, const ScoredFits& fits, const SearchOptions& options,
          bool of_prefix);
  Pruning(const Pruning&) = delete;
  Pruning& operator=(const Pruning&) = delete;

  PrunedStructure Prune(Scored kept) const;
  std::vector<Misfit> Evaluate(const std::vector<Structure>& structures) const;
  /// Gains of `after` over `before` in pieces of TRAIN and SELECT.
  std::vector<ManoeuvreGain> GainsOnSeen(const Misfit& before, const Misfit& after) const;
  const Scored& nothing() const { return nothing_; }
  /// Gain of the flexible regressor over the empty structure on SELECT.
  double flexible_gain() const { return flexible_gain_; }

 private:
  PrunedStructure Prune(Scored kept, Misfit crossed_kept) const;
  TermEvidence EvidenceOf(const Scored& with, const Scored& without, const Misfit& crossed_with,
                          const Misfit& crossed_without) const;
  bool IsNeeded(const TermEvidence& evidence) const;
  double JointP(const Scored& kept, const Misfit& crossed_kept, const PrunedStructure& rest) const;
  double FlexibleGain(const Misfit& misfit) const;

  const ReplayBlock& block_;
  const std::vector<Manoeuvre>& manoeuvres_;
  const Likelihood& likelihood_;
  const StructureFitter& fitter_;
  const ScoredFits& fits_;
  const SearchOptions& options_;
  const bool of_prefix_;
  const std::vector<Segment> select_, seen_;
  const CrossFit crossed_;
  const Scored nothing_;
  const double flexible_gain_;
};

}  // namespace tera
