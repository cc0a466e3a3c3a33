#pragma once

#include <cstddef>
#include <vector>

#include "diagnose/search/fit/cross_fit.h"
#include "diagnose/search/fit/scored_fits.h"
#include "diagnose/search/fit/steady_gain.h"
#include "diagnose/search/structure/structure_search.h"

namespace tera {

/// A structure of which every term is needed.
struct Needed {
  Scored structure;
  Misfit crossed;  ///< as fits leave it that have not seen what they are judged on
  std::vector<TermEvidence> evidence;  ///< one for each term, without rivals
};

/// Takes from a structure what it does as well without.
///
/// Model   the term that is needed least goes, until all are needed (StructureSearch says when one
///         is). Where one alone is not needed, by its probability alone, and one other goes as well
///         without it, the two are tested together against what is then left, times the number of
///         tests once for each: play in a joint that pulls harder than it pushes is needed only
///         beside that.
/// Omits   that the pair was chosen by the same manoeuvres, beyond the number of tests; pairs of
///         which neither is needed. FINAL asks for each of the two by itself.
class Pruning {
 public:
  /// `likelihood`, `fitter` and `fits` are of TRAIN. All must outlive it. `of_prefix`: a fit
  /// goes a few steps, as one of the prefix is not repeated.
  Pruning(const ReplayBlock& block, const std::vector<NoiseModel>& noise,
          const std::vector<Manoeuvre>& manoeuvres, const Likelihood& likelihood,
          const StructureFitter& fitter, const ScoredFits& fits, const SearchOptions& options,
          bool of_prefix);
  Pruning(const Pruning&) = delete;
  Pruning& operator=(const Pruning&) = delete;

  Needed Prune(Scored kept) const;
  /// What structures leave of manoeuvres that they were not fitted to.
  std::vector<Misfit> Judge(const std::vector<Structure>& structures) const;
  /// What one misfit gains over another in pieces of TRAIN and SELECT.
  std::vector<ManoeuvreGain> GainsOnSeen(const Misfit& before, const Misfit& after) const;
  /// The structure without terms.
  const Scored& nothing() const { return nothing_; }
  /// What the flexible regressor gains over nothing on SELECT.
  double flexible_gain() const { return flexible_gain_; }

 private:
  Needed Prune(Scored kept, Misfit crossed_kept) const;
  TermEvidence EvidenceOf(const Scored& with, const Scored& without, const Misfit& crossed_with,
                          const Misfit& crossed_without) const;
  bool IsNeeded(const TermEvidence& evidence) const;
  double TogetherP(const Scored& kept, const Misfit& crossed_kept, const Needed& rest) const;
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
