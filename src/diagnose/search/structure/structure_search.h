#pragma once

#include <memory>
#include <vector>

#include "diagnose/search/fit/structure_fit.h"
#include "diagnose/search/structure/search_result.h"
#include "diagnose/statistics/series/manoeuvres.h"

namespace tera {

/// Searches the set of candidates that together explain a block.
///
/// Model   Backward search, if the block has initial estimates of its whole chain
///         (ReplayBlock::read_whole). All estimated terms are fitted together. Terms are removed
///         one by one while the Bayesian information criterion on TRAIN improves, then others are
///         added likewise.
///
///         Forward search. It is skipped where the backward result has more than four terms and a
///         better criterion than the forward start. Every candidate is fitted alone. The screened
///         candidates are the likeliest ones, and the likeliest of each slot. Without a chain,
///         pairs of screened candidates are fitted too: the eight likeliest after few steps are
///         fitted in full. The search grows from the best single candidate, and from the best pair
///         if that is better. It adds terms with an effect of at least kLeastTermEffect while the
///         criterion improves. After each addition it tries swaps; the four likeliest are fitted in
///         full.
///
///         Choice between both directions by the criterion. Among equally good structures, the one
///         whose terms cancel each other less is chosen.
///
///         Pruning (pruning.h). A term is removed unless its gain over the structure fitted without
///         it is steady on cross-fitted manoeuvres of TRAIN and SELECT (cross_fit.h,
///         steady_gain.h). Its p-value carries a Bonferroni correction over all tests of the
///         diagnosis. Its share, its share of the rest and its effect must reach the smallest
///         values of search_result.h. A term that is another mechanism in disguise is removed too
///         (Candidate::is_itself). A refining parameter returns to its default if that changes less
///         than kLeastTermEffect.
///
///         Rivals (DiscriminateRivals). Each term is swapped for each screened candidate. The five
///         likeliest swaps after few steps are compared with the term (rivals.h).
///
/// Omits   selection of the tested structures on part of the same manoeuvres, beyond the number of
///         candidates. FINAL guards against it.
/// Source  Schwarz 1978.
class StructureSearch {
 public:
  /// `noise` has one model per channel; `on_seen` fits to TRAIN and SELECT. With an `earlier`
  /// search, the new search starts from its result. Single candidates keep the values of the
  /// earlier fits; if the earlier search found nothing, the four likeliest are refitted. The
  /// structure of the earlier search is tried instead of pairs of candidates. All arguments except
  /// the noise must outlive the search unchanged.
  StructureSearch(const ReplayBlock& block, const std::vector<NoiseModel>& noise,
                  const StructureFitter& on_seen, const std::vector<Manoeuvre>& manoeuvres,
                  const SearchOptions& options, const EarlierSearch& earlier = {});
  ~StructureSearch();

  /// Searches without comparing rivals.
  SearchResult Find();
  /// Compares the terms of the last Find with their rivals.
  void DiscriminateRivals(SearchResult* result);

 private:
  struct Work;
  std::unique_ptr<Work> work_;
};

}  // namespace tera
