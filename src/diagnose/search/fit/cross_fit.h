#pragma once

#include <memory>
#include <vector>

#include "diagnose/search/fit/likelihood.h"
#include "diagnose/search/fit/replay_block.h"
#include "diagnose/search/fit/structure_fit.h"
#include "diagnose/statistics/series/manoeuvres.h"

namespace tera {

/// Cross-fitted misfits: each manoeuvre of TRAIN and SELECT is judged by a fit to the other
/// manoeuvres.
///
/// Model   the moving manoeuvres are dealt to five folds in order, and so are those at rest. A
///         structure is fitted five times, each time to four folds, and evaluated on the fifth.
///         Thus every manoeuvre counts. A single held-out part has too few manoeuvres to
///         distinguish a steady gain from chance.
/// Omits   the dependence between fits that share most of their manoeuvres. Each fit starts from
///         values that may depend on all manoeuvres. It makes three steps, in which parameters with
///         kinks hardly move.
/// Source  Stone 1974, "Cross-validatory choice and assessment of statistical predictions".
class CrossFit {
 public:
  /// All arguments must outlive this object.
  CrossFit(const ReplayBlock& block, const std::vector<NoiseModel>& noise,
           const std::vector<Manoeuvre>& manoeuvres);

  /// Misfits of structures. A sample of TRAIN or SELECT comes from the fit that left its fold out;
  /// all other samples come from the first fit.
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
