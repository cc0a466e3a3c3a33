#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <numeric>
#include <tuple>
#include <vector>

#include "diagnose/search/fit/likelihood.h"
#include "diagnose/search/fit/structure_fit.h"

namespace tera {

/// A structure with the scores of its fit, without the innovations, which would be much to keep.
struct Scored {
  Structure terms;
  double log_likelihood = 0;  ///< on the samples that it was fitted to
  /// Bayesian information criterion, as log-likelihood less penalty; minus infinity where a term is
  /// another mechanism in disguise (Candidate::is_itself).
  double criterion = 0;
  std::vector<double> held_out;  ///< log-likelihood by manoeuvre of SELECT

  double held_out_sum() const { return std::accumulate(held_out.begin(), held_out.end(), 0.0); }
};

/// Fits and scores many structures at a time; only the likeliest after a few steps are fitted in
/// full.
class ScoredFits {
 public:
  using Fit = std::function<FittedStructure(const Structure&)>;

  /// Fitter and likelihood are of the same samples and must outlive it. `select` are the manoeuvres
  /// of the held-out scores.
  ScoredFits(const StructureFitter& fitter, const Likelihood& likelihood,
             std::vector<Segment> select, int threads);

  Scored Score(const FittedStructure& fitted) const;
  std::vector<Scored> All(const std::vector<Structure>& structures, const Fit& fit) const;
  /// The likeliest of structures that were fitted by a few steps, fitted in full and sorted
  /// by likelihood.
  std::vector<Scored> Likeliest(std::vector<Scored> by_few_steps, std::size_t most);
  /// Likeliest for structures in which all terms but the last are fitted already.
  std::vector<Scored> LikeliestNear(const std::vector<Structure>& structures, std::size_t most);

 private:
  /// The start of a fit, by which its result is remembered.
  using Key =
      std::vector<std::tuple<const Candidate*, std::vector<double>, std::vector<std::size_t>>>;

  static Key KeyOf(const Structure& terms);
  std::vector<Scored> Once(const std::vector<Structure>& structures, std::map<Key, Scored>* known,
                           const Fit& fit) const;

  const StructureFitter& fitter_;
  const Likelihood& likelihood_;
  std::vector<Segment> select_;
  int threads_;
  double rows_ = 0;                      ///< samples fitted to
  std::map<Key, Scored> near_, fitted_;  ///< results of few steps, and in full
};

}  // namespace tera
