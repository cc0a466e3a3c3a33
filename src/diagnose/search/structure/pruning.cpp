#include "diagnose/search/structure/pruning.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/in_parallel.h"
#include "diagnose/search/fit/flexible_regressor.h"
#include "diagnose/search/structure/effect_size.h"

namespace tera {
namespace {

/// Structures up to this size are also fitted from distant starts. In larger ones, the other terms
/// hold each term in place.
constexpr std::size_t kMostTermsFittedAnew = 3;

}  // namespace

Pruning::Pruning(const ReplayBlock& block, const std::vector<NoiseModel>& noise,
                 const std::vector<Manoeuvre>& manoeuvres, const Likelihood& likelihood,
                 const StructureFitter& fitter, const ScoredFits& fits,
                 const SearchOptions& options, bool of_prefix)
    : block_(block),
      manoeuvres_(manoeuvres),
      likelihood_(likelihood),
      fitter_(fitter),
      fits_(fits),
      options_(options),
      of_prefix_(of_prefix),
      select_(SegmentsOf(manoeuvres, Part::kSelect)),
      seen_(PiecesOf(SeenSegmentsOf(manoeuvres), block.period_s())),
      crossed_(block, noise, manoeuvres),
      nothing_(fits.Score(fitter.AsGiven({}))),
      flexible_gain_(FlexibleGain(fitter.AsGiven({}).misfit)) {}

std::vector<Misfit> Pruning::Evaluate(const std::vector<Structure>& structures) const {
  return crossed_.Evaluate(structures, options_.threads);
}

std::vector<ManoeuvreGain> Pruning::GainsOnSeen(const Misfit& before, const Misfit& after) const {
  return GainsOf(likelihood_, before, after, seen_);
}

/// Gain on SELECT of the flexible regressor, fitted to TRAIN, over a misfit.
double Pruning::FlexibleGain(const Misfit& misfit) const {
  const Misfit free = ResidualBeyondFlexible(block_, likelihood_, misfit, manoeuvres_);
  double gain = 0;
  for (const ManoeuvreGain& one : GainsOf(likelihood_, misfit, free, select_)) gain += one.gain;
  return gain;
}

/// Joint evidence for the terms that `with` has and `without` lacks.
TermEvidence Pruning::EvidenceOf(const Scored& with, const Scored& without,
                                 const Misfit& crossed_with, const Misfit& crossed_without) const {
  TermEvidence evidence;
  const Misfit before = fitter_.AsGiven(without.terms).misfit;
  const double gained = with.held_out_sum() - without.held_out_sum();
  const double found = with.held_out_sum() - nothing_.held_out_sum();
  evidence.share = gained / std::max({flexible_gain_, found, 1e-9});
  const auto candidates = std::max(options_.total_candidates, block_.candidates.size());
  const double tests = std::pow(candidates, with.terms.size() - without.terms.size());
  const auto gains = GainsOnSeen(crossed_without, crossed_with);
  evidence.p = evidence.steady_p = std::min(1.0, tests * SteadyGainP(gains));
  if (evidence.share >= kLeastTermShareOfBet) {
    evidence.p = std::min(1.0, tests * GainP(gains));
  }
  evidence.share_of_rest = gained / std::max({FlexibleGain(before), gained, 1e-9});
  evidence.effect = EffectOf(block_, fitter_.AsGiven(with.terms).misfit, before);
  return evidence;
}

bool Pruning::IsNeeded(const TermEvidence& evidence) const {
  return evidence.joint_p.value_or(evidence.p) <= options_.alpha &&
         evidence.share >= kLeastTermShare && evidence.share_of_rest >= kLeastTermShareOfRest &&
         evidence.effect >= kLeastTermEffect;
}

/// p-value, by SteadyGainP, of the two terms together that `rest` lacks.
double Pruning::JointP(const Scored& kept, const Misfit& crossed_kept,
                       const PrunedStructure& rest) const {
  return EvidenceOf(kept, rest.structure, crossed_kept, rest.crossed).steady_p;
}

PrunedStructure Pruning::Prune(Scored kept) const {
  Misfit crossed = Evaluate({kept.terms}).front();
  return Prune(std::move(kept), std::move(crossed));
}

PrunedStructure Pruning::Prune(Scored kept, Misfit crossed_kept) const {
  std::vector<Structure> smaller;
  for (std::size_t t = 0; t < kept.terms.size(); ++t) smaller.push_back(Without(kept.terms, t));
  std::vector<Scored> without = fits_.All(smaller, [&](const Structure& terms) {
    const bool is_near = of_prefix_ || terms.size() > kMostTermsFittedAnew;
    return is_near ? fitter_.FitNear(terms) : fitter_.FitValues(terms);
  });
  std::vector<Structure> judged;
  for (const Scored& scored : without) judged.push_back(scored.terms);
  std::vector<Misfit> crossed = Evaluate(judged);
  std::vector<TermEvidence> evidence = InParallel<TermEvidence>(
      without.size(), options_.threads,
      [&](std::size_t t) { return EvidenceOf(kept, without[t], crossed_kept, crossed[t]); });
  std::vector<std::size_t> spare;
  for (std::size_t t = 0; t < without.size(); ++t) {
    if (!IsNeeded(evidence[t]) || !kept.terms[t].IsItself()) spare.push_back(t);
  }
  if (spare.empty()) return {std::move(kept), std::move(crossed_kept), std::move(evidence)};
  const std::size_t least = *std::min_element(
      spare.begin(), spare.end(),
      [&](std::size_t a, std::size_t b) { return evidence[a].share < evidence[b].share; });
  PrunedStructure rest = Prune(std::move(without[least]), std::move(crossed[least]));
  const bool one_other_goes = rest.structure.terms.size() + 2 == kept.terms.size();
  if (spare.size() > 1 || !one_other_goes || !kept.terms[least].IsItself()) return rest;
  evidence[least].joint_p = JointP(kept, crossed_kept, rest);
  if (IsNeeded(evidence[least])) {
    return {std::move(kept), std::move(crossed_kept), std::move(evidence)};
  }
  return rest;
}

}  // namespace tera
