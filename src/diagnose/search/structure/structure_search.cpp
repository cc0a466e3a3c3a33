#include "diagnose/search/structure/structure_search.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "diagnose/search/fit/scored_fits.h"
#include "diagnose/search/structure/effect_size.h"
#include "diagnose/search/structure/pruning.h"
#include "diagnose/search/structure/rivals.h"

namespace tera {
namespace {

/// Smallest gain in log-likelihood of a screened candidate that stands for its slot.
constexpr double kScreenedGain = 6;
constexpr std::size_t kMostScreened = 8;  ///< candidates in pairs and swaps
constexpr std::size_t kFullyFittedPairs = 8;
constexpr std::size_t kFullyFittedSteps = 4;  ///< swaps and additions fitted in full
constexpr std::size_t kFullyFittedRivals = 5;
/// Largest number of terms that the forward search reaches.
constexpr std::size_t kMostForwardTerms = 4;
/// Structures whose criteria differ by at most this, in log-likelihood, count as equally good.
constexpr double kEquallyLikely = 0.5;
/// A structure with less than this share of another one's sum of effects has less cancellation.
constexpr double kLessCancellation = 0.8;

void SortByCriterion(std::vector<Scored>* scored) {
  std::stable_sort(scored->begin(), scored->end(),
                   [](const Scored& a, const Scored& b) { return a.criterion > b.criterion; });
}

bool Has(const Structure& terms, const Candidate* candidate) {
  return std::any_of(terms.begin(), terms.end(),
                     [&](const Term& term) { return term.candidate == candidate; });
}

class Search {
 public:
  Search(const ReplayBlock& block, const std::vector<NoiseModel>& noise,
         const StructureFitter& on_seen, const std::vector<Manoeuvre>& manoeuvres,
         const SearchOptions& options, const EarlierSearch& earlier)
      : block_(block),
        on_seen_(on_seen),
        options_(options),
        earlier_(earlier),
        seen_(MaskOf(manoeuvres, Part::kTrain, block.samples())),
        likelihood_(block, noise, seen_),
        fitter_(block, likelihood_, {}, options.threads),
        fits_(fitter_, likelihood_, SegmentsOf(manoeuvres, Part::kSelect), options.threads),
        pruning_(block, noise, manoeuvres, likelihood_, fitter_, fits_, options_,
                 earlier.of_prefix),
        nothing_(pruning_.nothing()) {}
  Search(const Search&) = delete;
  Search& operator=(const Search&) = delete;

  SearchResult Find();
  void DiscriminateRivals(SearchResult* result);

 private:
  void FitSingles();
  void ReuseSingles();
  void Screen();
  bool ChangesEnough(const Structure& with, const Structure& without) const;
  Scored BestOf(const std::vector<Scored>& structures) const;
  Structure WholeOf(const std::vector<Reading>& readings) const;
  std::optional<Scored> SearchFromWhole();
  Scored Shrink(Scored best);
  std::vector<Scored> Pairs();
  Scored ExtendEarlier();
  Scored SearchFromScratch();
  const TermEvidence* EarlierEvidenceOf(const Candidate& candidate) const;
  Scored Grow(Scored best, std::size_t most = kMostStructureTerms);
  Scored Swap(Scored best);
  double SumOfEffects(const Structure& terms) const;
  Scored ReduceCancellation(Scored found);
  FittedStructure Simplest(FittedStructure fitted) const;
  FittedStructure FitToSeen();
  std::vector<Structure> NearestRivals(const Scored& found, std::size_t term);

  const ReplayBlock& block_;
  const StructureFitter& on_seen_;
  const SearchOptions& options_;
  const EarlierSearch earlier_;
  const Mask seen_;               ///< TRAIN
  const Likelihood likelihood_;   ///< likelihood of TRAIN
  const StructureFitter fitter_;  ///< fits to TRAIN
  ScoredFits fits_;
  const Pruning pruning_;
  const Scored nothing_;
  std::vector<Scored> singles_;        ///< one per candidate, fitted alone
  std::vector<std::size_t> screened_;  ///< indices of candidates
  PrunedStructure pruned_;             ///< pruned structure of the last Find
};

void Search::FitSingles() {
  std::vector<Structure> structures;
  for (const Candidate& candidate : block_.candidates) {
    structures.push_back(With({}, candidate, candidate.starts.front()));
  }
  singles_ = fits_.All(structures, [&](const Structure& one) { return fitter_.FitValues(one); });
}

/// Takes single candidates as fitted earlier. If nothing was found, the likeliest are refitted: one
/// of them may be the whole cause.
void Search::ReuseSingles() {
  std::vector<Structure> structures;
  for (const SingleEvidence& single : earlier_.result->singles) {
    structures.push_back(With({}, *single.candidate, single.values));
  }
  singles_ = fits_.All(structures, [&](const Structure& one) { return fitter_.AsGiven(one); });
  if (!earlier_.result->found.terms.empty()) return;
  for (Scored& fitted : fits_.LikeliestNear(structures, kFullyFittedSteps)) {
    for (Scored& single : singles_) {
      const bool is_it = single.terms.front().candidate == fitted.terms.front().candidate;
      if (is_it && fitted.log_likelihood > single.log_likelihood) single = fitted;
    }
  }
}

void Search::Screen() {
  std::vector<std::size_t> order(block_.candidates.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return singles_[a].log_likelihood > singles_[b].log_likelihood;
  });
  std::set<Slot> slots;
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    const Slot slot = block_.candidates[order[rank]].mechanism->slot;
    const double gain = singles_[order[rank]].log_likelihood - nothing_.log_likelihood;
    const bool stands_for_slot = !slots.contains(slot) && gain > kScreenedGain;
    slots.insert(slot);
    if (rank < kMostScreened || stands_for_slot) screened_.push_back(order[rank]);
  }
}

Scored Search::BestOf(const std::vector<Scored>& structures) const {
  Scored best = nothing_;
  for (const Scored& scored : structures) {
    if (scored.criterion > best.criterion) best = scored;
  }
  return best;
}

/// The structure found under earlier noise, plus the candidates of some readings, clamped to their
/// bounds.
Structure Search::WholeOf(const std::vector<Reading>& readings) const {
  Structure whole;
  if (earlier_.result != nullptr) whole = earlier_.result->found.terms;
  for (const Reading& reading : readings) {
    const auto is_read = [&](const Candidate& candidate) {
      return candidate.mechanism->id == reading.mechanism && candidate.target == reading.target;
    };
    const auto own = std::find_if(block_.candidates.begin(), block_.candidates.end(), is_read);
    if (own == block_.candidates.end() || Has(whole, &*own)) continue;
    Term term{&*own, reading.values.empty() ? own->starts.front() : reading.values, reading.held};
    for (const FreeParameter& free : own->free) {
      double& value = term.values[free.index];
      value = std::clamp(value, free.lower, free.upper);
    }
    whole.push_back(std::move(term));
  }
  return whole;
}

/// Backward search from the whole chain. None if the block has no readings.
std::optional<Scored> Search::SearchFromWhole() {
  if (!block_.read_whole) return std::nullopt;
  std::vector<Structure> wholes;
  for (const auto& readings : block_.read_whole(block_.channels.front(), seen_)) {
    wholes.push_back(WholeOf(readings));
  }
  if (wholes.empty() || wholes.front().empty()) return std::nullopt;
  return Grow(Shrink(fits_.Score(fitter_.FitLikeliest(wholes))));
}

Scored Search::Shrink(Scored best) {
  while (!best.terms.empty()) {
    std::vector<Structure> smaller;
    for (std::size_t t = 0; t < best.terms.size(); ++t) smaller.push_back(Without(best.terms, t));
    std::vector<Scored> fitted = fits_.All(
        smaller, [&](const Structure& terms) { return fitter_.FitFrom(terms, Effort::kFewSteps); });
    SortByCriterion(&fitted);
    if (fitted.front().criterion <= best.criterion) break;
    best = std::move(fitted.front());
  }
  return fits_.Score(fitter_.FitFrom(best.terms));
}

/// The likeliest pairs of screened candidates. None where no candidate gains alone.
std::vector<Scored> Search::Pairs() {
  std::vector<Structure> pairs;
  const bool any = std::any_of(singles_.begin(), singles_.end(), [&](const Scored& single) {
    return single.log_likelihood - nothing_.log_likelihood > kScreenedGain;
  });
  for (std::size_t a = 0; any && a < screened_.size(); ++a) {
    for (std::size_t b = a + 1; b < screened_.size(); ++b) {
      const Scored& first = singles_[screened_[a]];
      const Term& second = singles_[screened_[b]].terms.front();
      pairs.push_back(With(first.terms, *second.candidate, second.values));
    }
  }
  const auto few_steps = [&](const Structure& pair) {
    return fitter_.FitValues(pair, Effort::kFewSteps);
  };
  return fits_.Likeliest(fits_.All(pairs, few_steps), kFullyFittedPairs);
}

/// Searches backward from the whole chain, then forward. The forward search starts from the best
/// single candidate, or from the structure found under earlier noise. Without a chain it also
/// starts from the best pair, which need not contain the best single candidate. It is skipped where
/// the backward result is better than its start and has more terms than the forward search may
/// reach.
Scored Search::SearchFromScratch() {
  std::vector<Scored> grown;
  if (auto whole = SearchFromWhole()) grown.push_back(*std::move(whole));
  const Scored single = BestOf(singles_);
  Scored other = nothing_;
  if (earlier_.result != nullptr) {
    other = fits_.Score(fitter_.FitNear(earlier_.result->found.terms));
  } else if (grown.empty()) {
    other = BestOf(Pairs());
  }
  const bool is_better = other.criterion > single.criterion;
  if (!grown.empty() && grown.front().terms.size() > kMostForwardTerms &&
      grown.front().criterion > std::max(single.criterion, other.criterion)) {
    return ReduceCancellation(std::move(grown.front()));
  }
  if (!is_better || grown.empty()) grown.push_back(Grow(Swap(single), kMostForwardTerms));
  if (is_better) grown.push_back(Grow(Swap(other), kMostForwardTerms));
  return ReduceCancellation(BestOf(grown));
}

/// Extends the prefix's structure by effects that only the whole block shows.
Scored Search::ExtendEarlier() {
  const Structure& found = earlier_.result->found.terms;
  if (!found.empty()) return Grow(fits_.Score(fitter_.FitFrom(found)));
  std::vector<Scored> singles = singles_;
  SortByCriterion(&singles);
  const auto first = std::find_if(singles.begin(), singles.end(), [&](const Scored& single) {
    return single.criterion <= nothing_.criterion || ChangesEnough(single.terms, {});
  });
  const bool is_any = first != singles.end() && first->criterion > nothing_.criterion;
  return is_any ? Grow(std::move(*first)) : nothing_;
}

/// True if a change is large enough to survive pruning.
bool Search::ChangesEnough(const Structure& with, const Structure& without) const {
  const Misfit misfit = fitter_.AsGiven(with).misfit;
  return EffectOf(block_, misfit, fitter_.AsGiven(without).misfit) >= kLeastTermEffect;
}

Scored Search::Grow(Scored best, std::size_t most) {
  while (!best.terms.empty() && best.terms.size() < most) {
    std::vector<Structure> larger;
    for (const Scored& single : singles_) {
      const Term& term = single.terms.front();
      if (!Has(best.terms, term.candidate)) {
        larger.push_back(With(best.terms, *term.candidate, term.values));
      }
    }
    std::vector<Scored> fitted = fits_.LikeliestNear(larger, kFullyFittedSteps);
    SortByCriterion(&fitted);
    const auto next = std::find_if(fitted.begin(), fitted.end(), [&](const Scored& scored) {
      return scored.criterion <= best.criterion || ChangesEnough(scored.terms, best.terms);
    });
    if (next == fitted.end() || next->criterion <= best.criterion) break;
    best = earlier_.of_prefix ? std::move(*next) : Swap(std::move(*next));
  }
  return best;
}

/// The best structure after at most one swap of a term for a screened candidate.
Scored Search::Swap(Scored best) {
  std::vector<Structure> swapped;
  for (std::size_t t = 0; t < best.terms.size(); ++t) {
    for (const std::size_t s : screened_) {
      const Term& term = singles_[s].terms.front();
      if (Has(best.terms, term.candidate)) continue;
      swapped.push_back(With(Without(best.terms, t), *term.candidate, term.values));
    }
  }
  for (Scored& scored : fits_.LikeliestNear(swapped, kFullyFittedSteps)) {
    if (scored.criterion > best.criterion) best = std::move(scored);
  }
  return best;
}

/// Sum of the effects of all terms. It is large where terms cancel each other.
double Search::SumOfEffects(const Structure& terms) const {
  const Misfit all = fitter_.AsGiven(terms).misfit;
  double sum = 0;
  for (std::size_t t = 0; t < terms.size(); ++t) {
    sum += EffectOf(block_, all, fitter_.AsGiven(Without(terms, t)).misfit);
  }
  return sum;
}

/// Replaces the structure by an equally good one with less cancellation. Example: an offset with
/// friction in one direction equals friction in both.
Scored Search::ReduceCancellation(Scored found) {
  for (std::size_t t = 0; found.terms.size() > 1 && t < found.terms.size(); ++t) {
    for (const Structure& other : NearestRivals(found, t)) {
      const Scored scored = fits_.Score(fitter_.AsGiven(other));
      if (scored.criterion < found.criterion - kEquallyLikely) continue;
      if (SumOfEffects(scored.terms) > kLessCancellation * SumOfEffects(found.terms)) continue;
      found = scored;
      break;
    }
  }
  return found;
}

/// Holds each refining parameter at its default where that changes less than kLeastTermEffect.
FittedStructure Search::Simplest(FittedStructure fitted) const {
  for (std::size_t t = 0; t < fitted.terms.size(); ++t) {
    for (const FreeParameter& free : fitted.terms[t].Free()) {
      const Candidate& candidate = *fitted.terms[t].candidate;
      const std::optional<double> usual = DefaultOf(candidate, free.index);
      if (!free.refines || !usual) continue;
      Structure simpler = fitted.terms;
      simpler[t].values[free.index] = *usual;
      simpler[t].held.push_back(free.index);
      FittedStructure refitted = on_seen_.Determine(on_seen_.FitFrom(simpler));
      if (EffectOf(block_, refitted.misfit, fitted.misfit) >= kLeastTermEffect) continue;
      fitted = std::move(refitted);
    }
  }
  return fitted;
}

/// The pruned structure fitted to TRAIN and SELECT together. Terms that turn out to be another
/// mechanism in disguise are removed.
FittedStructure Search::FitToSeen() {
  while (!pruned_.structure.terms.empty()) {
    const Structure& found = pruned_.structure.terms;
    FittedStructure fitted = Simplest(on_seen_.Determine(on_seen_.FitFrom(found)));
    const auto disguised = std::find_if(fitted.terms.begin(), fitted.terms.end(),
                                        [](const Term& term) { return !term.IsItself(); });
    if (disguised == fitted.terms.end()) return fitted;
    const auto at = static_cast<std::size_t>(disguised - fitted.terms.begin());
    pruned_ = pruning_.Prune(fits_.Score(fitter_.FitNear(Without(found, at))));
  }
  return on_seen_.AsGiven({});
}

/// The prefix's evidence for a term; null if the prefix did not find it.
const TermEvidence* Search::EarlierEvidenceOf(const Candidate& candidate) const {
  if (!earlier_.of_prefix) return nullptr;
  const Structure& found = earlier_.result->found.terms;
  for (std::size_t t = 0; t < found.size(); ++t) {
    if (found[t].candidate == &candidate) return &earlier_.result->evidence[t];
  }
  return nullptr;
}

/// The likeliest structures with one term swapped for screened candidates, or for the term's rivals
/// in the prefix.
std::vector<Structure> Search::NearestRivals(const Scored& found, std::size_t term) {
  std::vector<std::size_t> others = screened_;
  if (const TermEvidence* earlier = EarlierEvidenceOf(*found.terms[term].candidate)) {
    others.clear();
    for (const Candidate* rival : earlier->rivals) {
      others.push_back(static_cast<std::size_t>(rival - block_.candidates.data()));
    }
  }
  std::vector<Structure> swapped;
  for (const std::size_t s : others) {
    const Term& other = singles_[s].terms.front();
    if (Has(found.terms, other.candidate)) continue;
    swapped.push_back(With(Without(found.terms, term), *other.candidate, other.values));
  }
  std::vector<Structure> nearest;
  for (Scored& scored : fits_.LikeliestNear(swapped, kFullyFittedRivals)) {
    if (scored.terms.back().IsItself()) nearest.push_back(std::move(scored.terms));
  }
  return nearest;
}

SearchResult Search::Find() {
  SearchResult result;
  result.flexible_gain = pruning_.flexible_gain();
  if (earlier_.result != nullptr) {
    ReuseSingles();
  } else {
    FitSingles();
  }
  Screen();
  Scored full = earlier_.of_prefix ? ExtendEarlier() : SearchFromScratch();
  if (block_.read_whole) result.fullest = full.terms;
  pruned_ = pruning_.Prune(std::move(full));
  result.found = FitToSeen();
  if (!block_.read_whole) result.fullest = result.found.terms;
  result.evidence = pruned_.evidence;
  result.found_gain = pruned_.structure.held_out_sum() - nothing_.held_out_sum();
  result.nothing = on_seen_.AsGiven({});
  for (std::size_t s = 0; s < singles_.size(); ++s) {
    result.singles.push_back({&block_.candidates[s], singles_[s].terms.front().values,
                              singles_[s].log_likelihood - nothing_.log_likelihood,
                              singles_[s].held_out_sum() - nothing_.held_out_sum()});
  }
  return result;
}

void Search::DiscriminateRivals(SearchResult* result) {
  const Scored& found = pruned_.structure;
  const RivalTests tests(block_, fitter_, pruning_);
  for (std::size_t t = 0; t < found.terms.size(); ++t) {
    TermEvidence& evidence = result->evidence[t];
    evidence.rivals = {found.terms[t].candidate};
    if (const TermEvidence* earlier = EarlierEvidenceOf(*found.terms[t].candidate)) {
      evidence.rejected = earlier->rejected;
    }
    tests.Discriminate(found.terms, pruned_.crossed, NearestRivals(found, t), &evidence);
  }
}

}  // namespace

struct StructureSearch::Work {
  Search search;
};

StructureSearch::StructureSearch(const ReplayBlock& block, const std::vector<NoiseModel>& noise,
                                 const StructureFitter& on_seen,
                                 const std::vector<Manoeuvre>& manoeuvres,
                                 const SearchOptions& options, const EarlierSearch& earlier)
    : work_(new Work{Search(block, noise, on_seen, manoeuvres, options, earlier)}) {}

StructureSearch::~StructureSearch() = default;

SearchResult StructureSearch::Find() { return work_->search.Find(); }

void StructureSearch::DiscriminateRivals(SearchResult* result) {
  work_->search.DiscriminateRivals(result);
}

}  // namespace tera
