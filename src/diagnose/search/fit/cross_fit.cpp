#include "diagnose/search/fit/cross_fit.h"

#include <algorithm>

#include "core/in_parallel.h"

namespace tera {
namespace {

constexpr std::size_t kFolds = 5;

}  // namespace

CrossFit::CrossFit(const ReplayBlock& block, const std::vector<NoiseModel>& noise,
                   const std::vector<Manoeuvre>& manoeuvres)
    : folds_(kFolds) {
  std::size_t moving = 0, resting = 0;
  std::vector<Mask> seen(kFolds, Mask(block.samples(), 0));
  for (const Manoeuvre& manoeuvre : manoeuvres) {
    if (manoeuvre.part == Part::kFinal) continue;
    const std::size_t own = (manoeuvre.axes == 0 ? resting++ : moving++) % kFolds;
    folds_[own].unseen.push_back(manoeuvre.samples);
    for (std::size_t f = 0; f < kFolds; ++f) {
      if (f == own) continue;
      std::fill(seen[f].begin() + static_cast<std::ptrdiff_t>(manoeuvre.samples.begin),
                seen[f].begin() + static_cast<std::ptrdiff_t>(manoeuvre.samples.end), 1);
    }
  }
  for (std::size_t f = 0; f < kFolds; ++f) {
    folds_[f].likelihood = std::make_unique<Likelihood>(block, noise, seen[f]);
    folds_[f].fitter =
        std::make_unique<StructureFitter>(block, *folds_[f].likelihood, std::vector<Segment>{});
  }
}

std::vector<Misfit> CrossFit::Evaluate(const std::vector<Structure>& structures,
                                       int threads) const {
  const std::vector<Misfit> left =
      InParallel<Misfit>(structures.size() * folds_.size(), threads, [&](std::size_t k) {
        const StructureFitter& fitter = *folds_[k % folds_.size()].fitter;
        return fitter.FitFrom(structures[k / folds_.size()], Effort::kFewSteps).misfit;
      });
  std::vector<Misfit> out;
  for (std::size_t s = 0; s < structures.size(); ++s) {
    out.push_back(left[s * folds_.size()]);
    for (std::size_t f = 1; f < folds_.size(); ++f) {
      for (const Segment& samples : folds_[f].unseen) {
        CopySamples(left[s * folds_.size() + f], samples, &out.back());
      }
    }
  }
  return out;
}

}  // namespace tera
