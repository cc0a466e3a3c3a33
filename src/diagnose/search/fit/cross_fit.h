#pragma once

#include <memory>
#include <vector>

#include "diagnose/search/fit/likelihood.h"
#include "diagnose/search/fit/replay_block.h"
#include "diagnose/search/fit/structure_fit.h"
#include "diagnose/statistics/series/manoeuvres.h"

namespace tera {

/// What structures leave of manoeuvres that they were not fitted to, of TRAIN and SELECT.
///
/// Model   the moving manoeuvres, in order, are dealt to five folds, those at rest likewise. A
///         structure is fitted five times, each time to all folds but one, and judged on that one:
///         every manoeuvre speaks of it, where a single part held out has too few to tell steady
///         from lucky.
/// Omits   that the fits share most of their manoeuvres; that each begins at numbers which may have
///         seen all of them, and goes three steps: what has kinks hardly moves.
/// Source  Stone 1974, "Cross-validatory choice and assessment of statistical predictions".
class CrossFit {
 public:
  /// All must outlive it.
  CrossFit(const ReplayBlock& block, const std::vector<NoiseModel>& noise,
           const std::vector<Manoeuvre>& manoeuvres);

  /// The samples of TRAIN and SELECT as left by the fits that have not seen them; others as left by
  /// the first fit. Fits begin at the structures' values and go a few steps.
  std::vector<Misfit> Judge(const std::vector<Structure>& structures, int threads) const;

 private:
  struct Fold {
    std::vector<Segment> unseen;
    std::unique_ptr<const Likelihood> likelihood;
    std::unique_ptr<const StructureFitter> fitter;
  };

  std::vector<Fold> folds_;
};

}  // namespace tera
