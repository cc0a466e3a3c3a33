#pragma once

#include <memory>
#include <vector>

#include "diagnose/search/fit/likelihood.h"
#include "diagnose/search/fit/replay_block.h"
#include "diagnose/search/fit/structure_fit.h"
#include "diagnose/statistics/series/manoeuvres.h"

namespace tera {

/// Cross-fitted misfits: each manoeuvre of TRAIN and SELECT is judged by a fit to the others.
///
/// Model   the moving manoeuvres are dealt to five folds in order, and so are those at rest. A
///         structure is fitted five times, each time to four folds, and evaluated on the fifth.
///         Thus every manoeuvre counts. A single held-out part has too few to distinguish a steady
///         gain from luck.
/// Omits   that the fits share most of their manoeuvres. Each fit starts from numbers that may
///         depend on all manoeuvres and goes three steps, in which parameters with kinks hardly
///         move.
/// Source  Stone 1974, "Cross-validatory choice and assessment of statistical predictions".
class CrossFit {
 public:
  /// All arguments must outlive it.
  CrossFit(const ReplayBlock& block, const std::vector<NoiseModel>& noise,
           const std::vector<Manoeuvre>& manoeuvres);

  /// Misfits of structures. Samples of TRAIN and SELECT come from the fits without them, other
  /// samples from the first fit. Fits start from the structures' values and go a few steps.
  std::vector<Misfit> Evaluate(const std::vector<Structure>& structures, int threads) const;

 private:
  struct Fold {
    std::vector<Segment> unseen;
    std::unique_ptr<const Likelihood> likelihood;
    std::unique_ptr<const StructureFitter> fitter;
  };

  std::vector<Fold> folds_;
};

}  // namespace tera
