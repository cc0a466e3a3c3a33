#pragma once

#include <memory>
#include <vector>

#include "diagnose/search/fit/structure_fit.h"
#include "diagnose/search/structure/search_result.h"
#include "diagnose/statistics/series/manoeuvres.h"

namespace tera {

/// Search for the candidates that together explain a block.
///
/// Model   Backward from the whole chain, if the block reads one (ReplayBlock::read_whole): all
///         readings are fitted together. Terms are removed one by one while the Bayesian
///         information criterion on TRAIN falls, then others are added likewise.
///         Forward, unless the backward result has more than four terms and a better criterion than
///         the forward start. Every candidate is fitted alone. Without a chain, so are pairs of the
///         screened ones (the likeliest, and the likeliest of each slot). The eight pairs that are
///         likeliest after few steps are fitted in full. The search grows from the best single
///         candidate, and from the best pair if that is better. It adds a term with an effect of at
///         least kLeastTermEffect while the criterion falls, with swaps, four of them fitted in
///         full.
///         Choice: the likelier result of both directions. Among equally likely ones, that whose
///         terms cancel each other less.
///         Pruning (pruning.h): a term is removed unless its gain over the structure fitted without
///         it is steady on cross-fitted manoeuvres of TRAIN and SELECT (cross_fit.h,
///         steady_gain.h). Its p-value is corrected by Bonferroni over all tests of the diagnosis.
///         Its share, share of the rest and effect beyond nuisances must reach the least values of
///         search_result.h. A term that is another mechanism in disguise is removed too
///         (Candidate::is_itself). A refining parameter returns to its default if that changes less
///         than kLeastTermEffect, one parameter after the other.
///         Rivals (DiscriminateRivals): each term is swapped for each screened candidate, and the
///         five likeliest after few steps are compared (rivals.h).
/// Omits   selection of the tested structures on part of the same manoeuvres, beyond the number of
///         candidates; FINAL guards against it.
/// Source  Schwarz 1978.
class StructureSearch {
 public:
  /// `noise` has a model for each channel; `on_seen` fits to TRAIN and SELECT. A search after an
  /// earlier one starts from its result. Single candidates keep their earlier values; if nothing
  /// was found, the four likeliest are fitted anew. The earlier structure replaces the pairs. All
  /// arguments except the noise must outlive the search unchanged.
  StructureSearch(const ReplayBlock& block, const std::vector<NoiseModel>& noise,
                  const StructureFitter& on_seen, const std::vector<Manoeuvre>& manoeuvres,
                  const SearchOptions& options, const EarlierSearch& earlier = {});
  ~StructureSearch();

  /// Searches, without the rivals of the terms.
  SearchResult Find();
  /// Adds the rivals of each term of the last result of Find.
  void DiscriminateRivals(SearchResult* result);

 private:
  struct Work;
  std::unique_ptr<Work> work_;
};

}  // namespace tera
