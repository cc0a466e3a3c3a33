#include "diagnose/search/fit/scored_fits.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "core/in_parallel.h"

namespace tera {
namespace {

void SortByLikelihood(std::vector<Scored>* scored) {
  std::stable_sort(scored->begin(), scored->end(), [](const Scored& a, const Scored& b) {
    return a.log_likelihood > b.log_likelihood;
  });
}

}  // namespace

ScoredFits::ScoredFits(const StructureFitter& fitter, const Likelihood& likelihood,
                       std::vector<Segment> select, int threads)
    : fitter_(fitter), likelihood_(likelihood), select_(std::move(select)), threads_(threads) {
  for (std::size_t c = 0; c < likelihood.noise().size(); ++c) {
    rows_ += static_cast<double>(likelihood.fitted_samples(c).size());
  }
}

ScoredFits::Key ScoredFits::KeyOf(const Structure& terms) {
  Key key;
  for (const Term& term : terms) key.emplace_back(term.candidate, term.values, term.held);
  return key;
}

Scored ScoredFits::Score(const FittedStructure& fitted) const {
  Scored scored{fitted.terms, fitted.log_likelihood, 0, {}};
  double parameters = 0;
  for (const Term& term : fitted.terms)
    parameters += 1 + static_cast<double>(term.candidate->free.size());
  scored.criterion = fitted.log_likelihood - 0.5 * parameters * std::log(rows_);
  if (!std::all_of(fitted.terms.begin(), fitted.terms.end(), std::mem_fn(&Term::IsItself))) {
    scored.criterion = -std::numeric_limits<double>::infinity();
  }
  for (const Segment& manoeuvre : select_) {
    scored.held_out.push_back(likelihood_.Sum(fitted.misfit, manoeuvre));
  }
  return scored;
}

std::vector<Scored> ScoredFits::All(const std::vector<Structure>& structures,
                                    const Fit& fit) const {
  return InParallel<Scored>(structures.size(), threads_,
                            [&](std::size_t k) { return Score(fit(structures[k])); });
}

/// Fits each structure once, since swaps and rivals repeat many.
std::vector<Scored> ScoredFits::Once(const std::vector<Structure>& structures,
                                     std::map<Key, Scored>* known, const Fit& fit) const {
  std::vector<Structure> fresh;
  for (const Structure& terms : structures) {
    if (known->try_emplace(KeyOf(terms)).second) fresh.push_back(terms);
  }
  std::vector<Scored> fitted = All(fresh, fit);
  for (std::size_t k = 0; k < fresh.size(); ++k) (*known)[KeyOf(fresh[k])] = std::move(fitted[k]);
  std::vector<Scored> all;
  for (const Structure& terms : structures) all.push_back(known->at(KeyOf(terms)));
  return all;
}

std::vector<Scored> ScoredFits::Likeliest(std::vector<Scored> by_few_steps, std::size_t most) {
  SortByLikelihood(&by_few_steps);
  by_few_steps.resize(std::min(most, by_few_steps.size()));
  std::vector<Structure> structures;
  for (Scored& scored : by_few_steps) structures.push_back(std::move(scored.terms));
  std::vector<Scored> fitted =
      Once(structures, &fitted_, [&](const Structure& terms) { return fitter_.FitFrom(terms); });
  SortByLikelihood(&fitted);
  return fitted;
}

std::vector<Scored> ScoredFits::LikeliestNear(const std::vector<Structure>& structures,
                                              std::size_t most) {
  return Likeliest(
      Once(structures, &near_,
           [&](const Structure& terms) { return fitter_.FitNear(terms, Effort::kFewSteps); }),
      most);
}

}  // namespace tera
