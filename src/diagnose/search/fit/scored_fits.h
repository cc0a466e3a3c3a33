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

/// A structure with the scores of its fit. The misfit itself is omitted, because it needs much
/// memory.
struct Scored {
  Structure terms;
  double log_likelihood = 0;
  /// Bayesian information criterion as log-likelihood minus penalty: larger is better. Minus
  /// infinity if a term is another mechanism in disguise (Candidate::is_itself).
  double criterion = 0;
  std::vector<double> held_out;  ///< log-likelihood of each manoeuvre of SELECT

  double held_out_sum() const { return std::accumulate(held_out.begin(), held_out.end(), 0.0); }
};

/// Fits and scores many structures. Only the likeliest after a few steps are fitted in full.
class ScoredFits {
 public:
  using Fit = std::function<FittedStructure(const Structure&)>;

  /// Fitter and likelihood use the same samples and must outlive this object. `select` has the
  /// manoeuvres of the held-out scores.
  ScoredFits(const StructureFitter& fitter, const Likelihood& likelihood,
             std::vector<Segment> select, int threads);

  Scored Score(const FittedStructure& fitted) const;
  std::vector<Scored> All(const std::vector<Structure>& structures, const Fit& fit) const;
  /// The likeliest of structures fitted by a few steps. They are fitted in full and sorted by
  /// likelihood.
  std::vector<Scored> Likeliest(std::vector<Scored> by_few_steps, std::size_t most);
  /// Likeliest for structures whose terms except the last are already fitted.
  std::vector<Scored> LikeliestNear(const std::vector<Structure>& structures, std::size_t most);

 private:
  /// Starting values of a fit, as the key of its cached result.
  using Key =
      std::vector<std::tuple<const Candidate*, std::vector<double>, std::vector<std::size_t>>>;

  static Key KeyOf(const Structure& terms);
  std::vector<Scored> Once(const std::vector<Structure>& structures, std::map<Key, Scored>* known,
                           const Fit& fit) const;

  const StructureFitter& fitter_;
  const Likelihood& likelihood_;
  std::vector<Segment> select_;
  int threads_;
  double rows_ = 0;                      ///< number of fitted samples
  std::map<Key, Scored> near_, fitted_;  ///< cached results after few steps, and in full
};

}  // namespace tera
