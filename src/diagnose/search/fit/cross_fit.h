#pragma once

#include <memory>
#include <vector>

#include "diagnose/search/fit/likelihood.h"
#include "diagnose/search/fit/replay_block.h"
#include "diagnose/search/fit/structure_fit.h"
#include "diagnose/statistics/series/manoeuvres.h"

namespace tera {

/// Cross-fitted misfits: what structures leave of the manoeuvres of TRAIN and SELECT by fits that
/// have not seen them.
///
/// Model   the moving manoeuvres are dealt to five folds in order, and so are those at rest. A
///         structure is fitted five times, each time to all folds but one, and evaluated on that
///         one. So every manoeuvre counts; a single held-out part has too few to distinguish a
///         steady gain from luck.
/// Omits   that the fits share most of their manoeuvres; that each starts from numbers which may
///         have seen all of them and goes three steps, in which parameters with kinks hardly move.
/// Source  Stone 1974, "Cross-validatory choice and assessment of statistical predictions".
class CrossFit {
 public:
  /// All arguments must outlive it.
  CrossFit(const ReplayBlock& block, const std::vector<NoiseModel>& noise,
           const std::vector<Manoeuvre>& manoeuvres);

  /// The misfits of structures: samples of TRAIN and SELECT by the fits that have not seen them,
  /// others by the first fit. Fits start from the structures' values and go a few steps.
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
