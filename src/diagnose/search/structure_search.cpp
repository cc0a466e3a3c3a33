#include "diagnose/search/structure_search.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "diagnose/search/cross_fit.h"
#include "diagnose/search/free_member.h"
#include "diagnose/search/in_parallel.h"
#include "diagnose/search/steady_gain.h"

namespace tera {
namespace {

constexpr double kScreenedGain = 6;  ///< of log-likelihood: it may mean something
constexpr std::size_t kNearest = 5;  ///< rivals that a term is held against
constexpr double kAsLikely = 0.5;    ///< of log-likelihood
constexpr double kCalmer = 0.8;      ///< of the sum of effects
constexpr double kRivalP = 0.05;
constexpr double kRivalGain = 3;  ///< of log-likelihood: nothing to choose by

/// A structure and how it stands, without the bulk of its innovations.
struct Scored {
  Structure terms;
  double log_likelihood = 0, criterion = 0;
  std::vector<double> held_out;  ///< log-likelihood by manoeuvre of SELECT
};

double Total(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum;
}

std::vector<double> Differences(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> difference(a.size());
  for (std::size_t k = 0; k < a.size(); ++k) difference[k] = a[k] - b[k];
  return difference;
}

bool Has(const Structure& terms, const Suspect* suspect) {
  return std::any_of(terms.begin(), terms.end(),
                     [&](const Term& term) { return term.suspect == suspect; });
}

Structure Without(Structure terms, std::size_t k) {
  terms.erase(terms.begin() + static_cast<std::ptrdiff_t>(k));
  return terms;
}

Structure With(Structure terms, const Suspect& suspect, const std::vector<double>& values) {
  terms.push_back({&suspect, values});
  return terms;
}

class Search {
 public:
  Search(const ReplayBlock& block, const std::vector<NoiseModel>& noise,
         const StructureFitter& on_seen, const std::vector<Manoeuvre>& manoeuvres,
         const SearchOptions& options)
      : block_(block),
        on_seen_(on_seen),
        manoeuvres_(manoeuvres),
        options_(options),
        select_(SegmentsOf(manoeuvres, Part::kSelect)),
        seen_(PiecesOf(SeenSegmentsOf(manoeuvres), block.period_s())),
        likelihood_(block, noise, MaskOf(manoeuvres, Part::kTrain, block.samples())),
        fitter_(block, likelihood_, {}),
        crossed_(block, noise, manoeuvres) {
    for (std::size_t c = 0; c < block.channels.size(); ++c) {
      rows_ += static_cast<double>(likelihood_.fitted_samples(c).size());
    }
  }

  SearchResult Run(const SearchResult* before);

 private:
  Scored Score(const FittedStructure& fitted) const;
  std::vector<Scored> FitAll(const std::vector<Structure>& structures) const;
  std::vector<Scored> FitAllNear(const std::vector<Structure>& structures) const;
  void FitSingles();
  void TakeSingles(const std::vector<SingleEvidence>& before);
  void Screen();
  Scored BestOfPairs() const;
  Scored Grow(Scored best) const;
  Scored Swap(Scored best) const;
  double SumOfEffects(const Structure& terms) const;
  Scored Disentangle(Scored found) const;
  Scored Prune(Scored kept, std::vector<TermEvidence>* evidence) const;
  TermEvidence EvidenceOf(const Scored& with, const Misfit& crossed_with,
                          const Scored& without) const;
  bool IsNeeded(const TermEvidence& evidence) const;
  std::vector<Structure> NearestRivals(const Scored& found, std::size_t term) const;
  void FindRivals(const Scored& found, const Misfit& crossed, std::size_t term,
                  TermEvidence* evidence) const;
  double FreeGain(const Misfit& misfit) const;

  const ReplayBlock& block_;
  const StructureFitter& on_seen_;
  const std::vector<Manoeuvre>& manoeuvres_;
  const SearchOptions& options_;
  const std::vector<Segment> select_, seen_;
  const Likelihood likelihood_;   ///< of TRAIN
  const StructureFitter fitter_;  ///< to TRAIN
  const CrossFit crossed_;
  double rows_ = 0;
  Scored nothing_;
  std::vector<Scored> singles_;        ///< one a suspect
  std::vector<std::size_t> screened_;  ///< suspects
  double free_gain_ = 0;
};

Scored Search::Score(const FittedStructure& fitted) const {
  Scored scored{fitted.terms, fitted.log_likelihood, 0, {}};
  double parameters = 0;
  for (const Term& term : fitted.terms)
    parameters += 1 + static_cast<double>(term.suspect->free.size());
  scored.criterion = fitted.log_likelihood - 0.5 * parameters * std::log(rows_);
  for (const Segment& manoeuvre : select_) {
    scored.held_out.push_back(likelihood_.Sum(fitted.misfit, manoeuvre));
  }
  return scored;
}

std::vector<Scored> Search::FitAll(const std::vector<Structure>& structures) const {
  return InParallel<Scored>(structures.size(), options_.threads,
                            [&](std::size_t k) { return Score(fitter_.FitValues(structures[k])); });
}

std::vector<Scored> Search::FitAllNear(const std::vector<Structure>& structures) const {
  return InParallel<Scored>(structures.size(), options_.threads,
                            [&](std::size_t k) { return Score(fitter_.FitNear(structures[k])); });
}

void Search::FitSingles() {
  std::vector<Structure> structures;
  for (const Suspect& suspect : block_.suspects) {
    structures.push_back(With({}, suspect, suspect.starts.front()));
  }
  singles_ = FitAll(structures);
}

void Search::TakeSingles(const std::vector<SingleEvidence>& before) {
  singles_ = InParallel<Scored>(before.size(), options_.threads, [&](std::size_t k) {
    return Score(fitter_.AsGiven(With({}, *before[k].suspect, before[k].values)));
  });
}

void Search::Screen() {
  std::vector<std::size_t> order(block_.suspects.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return singles_[a].log_likelihood > singles_[b].log_likelihood;
  });
  std::set<Slot> slots;
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    const Slot slot = block_.suspects[order[rank]].mechanism->slot;
    const double gain = singles_[order[rank]].log_likelihood - nothing_.log_likelihood;
    const bool stands_for_slot = !slots.contains(slot) && gain > kScreenedGain;
    slots.insert(slot);
    if (rank < options_.screened || stands_for_slot) screened_.push_back(order[rank]);
  }
}

/// The best of nothing, all single suspects and all pairs of the screened; no pairs where no
/// suspect alone tells anything.
Scored Search::BestOfPairs() const {
  std::vector<Structure> pairs;
  const bool any = std::any_of(singles_.begin(), singles_.end(), [&](const Scored& single) {
    return single.log_likelihood - nothing_.log_likelihood > kScreenedGain;
  });
  for (std::size_t a = 0; any && a < screened_.size(); ++a) {
    for (std::size_t b = a + 1; b < screened_.size(); ++b) {
      const Scored& first = singles_[screened_[a]];
      const Term& second = singles_[screened_[b]].terms.front();
      pairs.push_back(With(first.terms, *second.suspect, second.values));
    }
  }
  Scored best = nothing_;
  const auto take = [&](const Scored& scored) {
    if (scored.criterion > best.criterion) best = scored;
  };
  for (const Scored& single : singles_) take(single);
  for (const Scored& pair : FitAll(pairs)) take(pair);
  return best;
}

/// One term more as long as the criterion rises.
Scored Search::Grow(Scored best) const {
  while (!best.terms.empty() && best.terms.size() < options_.deepest) {
    std::vector<Structure> larger;
    for (const Scored& single : singles_) {
      const Term& term = single.terms.front();
      if (!Has(best.terms, term.suspect)) {
        larger.push_back(With(best.terms, *term.suspect, term.values));
      }
    }
    bool grown = false;
    for (Scored& scored : FitAllNear(larger)) {
      if (scored.criterion <= best.criterion) continue;
      best = std::move(scored);
      grown = true;
    }
    if (!grown) break;
    best = Swap(std::move(best));
  }
  return best;
}

/// The best exchange of one term for a screened suspect, if any is better.
Scored Search::Swap(Scored best) const {
  std::vector<Structure> swapped;
  for (std::size_t t = 0; t < best.terms.size(); ++t) {
    for (const std::size_t s : screened_) {
      const Term& term = singles_[s].terms.front();
      if (Has(best.terms, term.suspect)) continue;
      swapped.push_back(With(Without(best.terms, t), *term.suspect, term.values));
    }
  }
  for (Scored& scored : FitAllNear(swapped)) {
    if (scored.criterion > best.criterion) best = std::move(scored);
  }
  return best;
}

/// Of what each term changes: large where terms undo each other.
double Search::SumOfEffects(const Structure& terms) const {
  const Misfit all = fitter_.AsGiven(terms).misfit;
  double sum = 0;
  for (std::size_t t = 0; t < terms.size(); ++t) {
    sum += EffectOf(block_, all, fitter_.AsGiven(Without(terms, t)).misfit);
  }
  return sum;
}

/// Of structures that are as likely, the one whose terms undo each other less: an offset and
/// friction in one direction do together what friction does.
Scored Search::Disentangle(Scored found) const {
  for (std::size_t t = 0; found.terms.size() > 1 && t < found.terms.size(); ++t) {
    for (const Structure& other : NearestRivals(found, t)) {
      const Scored scored = Score(fitter_.FitFrom(other));
      if (scored.criterion < found.criterion - kAsLikely) continue;
      if (SumOfEffects(scored.terms) > kCalmer * SumOfEffects(found.terms)) continue;
      found = scored;
      break;
    }
  }
  return found;
}

TermEvidence Search::EvidenceOf(const Scored& with, const Misfit& crossed_with,
                                const Scored& without) const {
  TermEvidence evidence;
  const Misfit crossed_without = crossed_.Judge(without.terms);
  const std::size_t tests = std::max(options_.suspects_in_all, block_.suspects.size());
  const double p = SteadyGainP(GainsOf(likelihood_, crossed_without, crossed_with, seen_));
  evidence.p = std::min(1.0, static_cast<double>(tests) * p);
  const Misfit before = fitter_.AsGiven(without.terms).misfit;
  const double gained = Total(Differences(with.held_out, without.held_out));
  const double found = Total(with.held_out) - Total(nothing_.held_out);
  evidence.share = gained / std::max({free_gain_, found, 1e-9});
  evidence.of_rest = gained / std::max({FreeGain(before), gained, 1e-9});
  evidence.effect = EffectOf(block_, fitter_.AsGiven(with.terms).misfit, before);
  return evidence;
}

bool Search::IsNeeded(const TermEvidence& evidence) const {
  return evidence.p <= options_.alpha && evidence.share >= options_.least_share &&
         evidence.of_rest >= options_.least_of_rest && evidence.effect >= options_.least_effect;
}

/// Removes the term that is needed least until all are needed.
Scored Search::Prune(Scored kept, std::vector<TermEvidence>* evidence) const {
  while (true) {
    std::vector<Structure> smaller;
    for (std::size_t t = 0; t < kept.terms.size(); ++t) smaller.push_back(Without(kept.terms, t));
    const std::vector<Scored> without = FitAll(smaller);
    const Misfit crossed = crossed_.Judge(kept.terms);
    *evidence = InParallel<TermEvidence>(without.size(), options_.threads, [&](std::size_t t) {
      return EvidenceOf(kept, crossed, without[t]);
    });
    std::size_t least = kept.terms.size();
    for (std::size_t t = 0; t < without.size(); ++t) {
      if (IsNeeded((*evidence)[t])) continue;
      if (least == kept.terms.size() || (*evidence)[t].share < (*evidence)[least].share) least = t;
    }
    if (least == kept.terms.size()) return kept;
    kept = without[least];
  }
}

/// The likeliest exchanges of one term for a screened suspect.
std::vector<Structure> Search::NearestRivals(const Scored& found, std::size_t term) const {
  std::vector<Structure> swapped;
  for (const std::size_t s : screened_) {
    const Term& other = singles_[s].terms.front();
    if (Has(found.terms, other.suspect)) continue;
    swapped.push_back(With(Without(found.terms, term), *other.suspect, other.values));
  }
  std::vector<Scored> fitted = FitAllNear(swapped);
  std::stable_sort(fitted.begin(), fitted.end(), [](const Scored& a, const Scored& b) {
    return a.log_likelihood > b.log_likelihood;
  });
  std::vector<Structure> nearest;
  for (std::size_t k = 0; k < std::min(kNearest, fitted.size()); ++k) {
    nearest.push_back(std::move(fitted[k].terms));
  }
  return nearest;
}

void Search::FindRivals(const Scored& found, const Misfit& crossed, std::size_t term,
                        TermEvidence* evidence) const {
  const std::vector<Structure> swapped = NearestRivals(found, term);
  evidence->rivals = {found.terms[term].suspect};
  const auto rivals = InParallel<Rival>(swapped.size(), options_.threads, [&](std::size_t k) {
    const auto gains = GainsOf(likelihood_, crossed_.Judge(swapped[k]), crossed, seen_);
    Rival rival{swapped[k].back().suspect, SteadyGainP(gains), 0};
    for (const ManoeuvreGain& one : gains) rival.lead += one.gain;
    return rival;
  });
  for (const Rival& rival : rivals) {
    if (rival.p > kRivalP || rival.lead < kRivalGain) {
      evidence->rivals.push_back(rival.suspect);
    } else {
      evidence->rejected.push_back(rival);
    }
  }
  std::stable_sort(evidence->rejected.begin(), evidence->rejected.end(),
                   [](const Rival& a, const Rival& b) { return a.lead < b.lead; });
}

/// What the free member gains on SELECT over a misfit of TRAIN.
double Search::FreeGain(const Misfit& misfit) const {
  const Misfit free = LessFreeMember(block_, likelihood_, misfit, manoeuvres_);
  double gain = 0;
  for (const ManoeuvreGain& one : GainsOf(likelihood_, misfit, free, select_)) gain += one.gain;
  return gain;
}

SearchResult Search::Run(const SearchResult* before) {
  SearchResult result;
  const FittedStructure nothing = fitter_.AsGiven({});
  nothing_ = Score(nothing);
  free_gain_ = result.free_gain = FreeGain(nothing.misfit);
  if (before != nullptr) {
    TakeSingles(before->singles);
  } else {
    FitSingles();
  }
  Screen();
  const Scored start =
      before != nullptr ? Score(fitter_.FitNear(before->found.terms)) : BestOfPairs();
  const Scored found = Prune(Disentangle(Grow(Swap(start))), &result.evidence);
  if (!found.terms.empty()) {
    const Misfit crossed = crossed_.Judge(found.terms);
    for (std::size_t t = 0; t < found.terms.size(); ++t) {
      FindRivals(found, crossed, t, &result.evidence[t]);
    }
  }
  result.nothing = on_seen_.AsGiven({});
  result.found = found.terms.empty() ? result.nothing : on_seen_.Fit(found.terms);
  for (std::size_t s = 0; s < singles_.size(); ++s) {
    result.singles.push_back({&block_.suspects[s], singles_[s].terms.front().values,
                              singles_[s].log_likelihood - nothing_.log_likelihood,
                              Total(singles_[s].held_out) - Total(nothing_.held_out)});
  }
  return result;
}

}  // namespace

double EffectOf(const ReplayBlock& block, const Misfit& with, const Misfit& without) {
  double largest = 0;
  for (std::size_t c = 0; c < with.residual.size(); ++c) {
    const Series& measured = block.channels[c].measured;
    double changed = 0, energy = 0;
    for (std::size_t k = 0; k < measured.size(); ++k) {
      if (!measured.valid[k]) continue;
      changed += std::pow(with.residual[c].value[k] - without.residual[c].value[k], 2);
      energy += std::pow(measured.value[k], 2);
    }
    if (energy > 0) largest = std::max(largest, std::sqrt(changed / energy));
  }
  return largest;
}

SearchResult SearchStructures(const ReplayBlock& block, const std::vector<NoiseModel>& noise,
                              const StructureFitter& on_seen,
                              const std::vector<Manoeuvre>& manoeuvres,
                              const SearchOptions& options, const SearchResult* before) {
  return Search(block, noise, on_seen, manoeuvres, options).Run(before);
}

}  // namespace tera
