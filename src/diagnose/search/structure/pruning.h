#pragma once

#include <cstddef>
#include <vector>

#include "diagnose/search/fit/cross_fit.h"
#include "diagnose/search/fit/scored_fits.h"
#include "diagnose/search/fit/steady_gain.h"
#include "diagnose/search/structure/search_result.h"
#include "diagnose/statistics/series/manoeuvres.h"

namespace tera {

/// A structure every term of which is needed.
struct PrunedStructure {
  Scored structure;
  Misfit crossed;                      ///< cross-fitted (cross_fit.h)
  std::vector<TermEvidence> evidence;  ///< one for each term, without rivals
};

/// Removes the terms of a structure that it does as well without.
///
/// Model   backward elimination: the least needed term goes, until all are needed (StructureSearch
///         says when one is). Where exactly one term would go, and one other goes too once it is
///         out, the two are tested together against the rest, with p corrected for the number of
///         tests once for each: play in a joint that pulls harder than it pushes is needed only
///         beside the asymmetry.
/// Omits   that the pair was chosen by the same manoeuvres, beyond the number of tests; pairs of
///         which neither term is needed by itself. FINAL is asked for each of the two by itself.
class Pruning {
 public:
  /// `likelihood`, `fitter` and `fits` are of TRAIN. All must outlive it. `of_prefix`: the
  /// structure was found in a prefix of the block; fits of smaller ones start from its values
  /// alone.
  Pruning(const ReplayBlock& block, const std::vector<NoiseModel>& noise,
          const std::vector<Manoeuvre>& manoeuvres, const Likelihood& likelihood,
          const StructureFitter& fitter, const ScoredFits& fits, const SearchOptions& options,
          bool of_prefix);
  Pruning(const Pruning&) = delete;
  Pruning& operator=(const Pruning&) = delete;

  /// The structure without the terms that are not needed.
  PrunedStructure Prune(Scored kept) const;
  /// Cross-fitted misfits of structures.
  std::vector<Misfit> Evaluate(const std::vector<Structure>& structures) const;
  /// Gains of one misfit over another in pieces of TRAIN and SELECT.
  std::vector<ManoeuvreGain> GainsOnSeen(const Misfit& before, const Misfit& after) const;
  /// The structure without terms.
  const Scored& nothing() const { return nothing_; }
  /// Gain of the flexible regressor over nothing on SELECT.
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
