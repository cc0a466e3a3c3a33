#pragma once

#include <memory>
#include <vector>

#include "diagnose/search/fit/structure_fit.h"
#include "diagnose/search/structure/search_result.h"
#include "diagnose/statistics/series/manoeuvres.h"

namespace tera {

/// The search for the candidates that explain a block together.
///
/// Model   From the whole chain, where the block reads one (ReplayBlock::read_whole): the readings
///         are fitted, all numbers together, and one term at a time leaves as long as the Bayesian
///         information criterion on TRAIN falls; then others enter so. Forward, unless that leaves
///         more than four terms that are likelier by the criterion than where this begins: every
///         candidate alone; without a chain pairs of the screened ones (the likeliest, and the
///         likeliest of each slot), of which the eight that are likeliest after a few steps are
///         fitted in full. Then, from the best single one, and from the best pair if that is
///         better, one term more at a time of at least `kLeastTermEffect`, with swaps, four fitted
///         in full, as long as the criterion falls. The likeliest of both ways counts; one whose
///         terms cancel each other less wins over one that is as likely. Pruning (pruning.h): a
///         term goes unless its gain over the structure fitted without it is steady over the
///         manoeuvres of TRAIN and SELECT, each left out of the fits that it judges (cross_fit.h,
///         steady_gain.h; Bonferroni over all that the diagnosis tests), and its share, share of
///         the rest and effect beyond nuisances are at least those of SearchOptions. It also goes
///         with numbers by which it is another mechanism in disguise (Candidate::is_itself). A
///         number that refines another one is put to its default where that changes less than
///         `kLeastTermEffect`, one number after the other. Rivals (DiscriminateRivals): each term
///         is swapped for each screened candidate. A rival is one of the five that are likeliest
///         after a few steps, over which the same manoeuvres do not gain from the term with p at
///         most kRivalP and at least kRivalGain; a rejected one is tried again with the
///         likeliest mechanism of timing or actuator beside it that is as expected
///         (expected_beside.h).
/// Omits   that the structures whose terms are tested were chosen on part of the same manoeuvres,
///         beyond the number of candidates; FINAL is for that.
/// Source  Schwarz 1978.
class StructureSearch {
 public:
  /// `noise` is of each channel; `on_seen` fits to TRAIN and SELECT. A search after an earlier one
  /// starts where that ended: single candidates have the numbers that they had there, the likeliest
  /// four are fitted anew where nothing was found, and what was found takes the place of pairs. All
  /// but the noise must outlive the search and stay as they are.
  StructureSearch(const ReplayBlock& block, const std::vector<NoiseModel>& noise,
                  const StructureFitter& on_seen, const std::vector<Manoeuvre>& manoeuvres,
                  const SearchOptions& options, const EarlierSearch& earlier = {});
  ~StructureSearch();

  /// The search, without the rivals of the terms.
  SearchResult Find();
  /// Fills in the rivals of each term of the structure that Find returned last.
  void DiscriminateRivals(SearchResult* result);

 private:
  struct Work;
  std::unique_ptr<Work> work_;
};

}  // namespace tera
