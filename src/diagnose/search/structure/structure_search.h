#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "diagnose/search/fit/structure_fit.h"
#include "diagnose/statistics/series/manoeuvres.h"

namespace tera {

/// A rival is rejected where the manoeuvres gain from the term in its place with p of at most
/// kRivalP and by at least kRivalGain of log-likelihood, below which there is nothing to choose by.
inline constexpr double kRivalP = 0.05, kRivalGain = 3;

struct SearchOptions {
  std::size_t screened = 8;  ///< candidates that pairs are made of
  std::size_t deepest = 4;   ///< terms in a structure, at most
  double alpha = 0.01;       ///< probability of any term where nothing acts, all tests together
  /// Candidates that the whole diagnosis tests, and channels whose residuals it judges: what
  /// p-values are corrected for. 0: those of the block alone.
  std::size_t total_candidates = 0, total_channels = 0;
  double least_share = 0.02;  ///< TermEvidence::share that a term must have
  /// TermEvidence::share that a term must have whose gain is clear by a bet and not steady.
  double least_share_of_bet = 0.1;
  double least_share_of_rest = 0.1;  ///< TermEvidence::share_of_rest that a term must have
  double least_effect = 0.02;        ///< TermEvidence::effect that a term must have
  int threads = 2;
};

/// A candidate that was tried in a term's place: the structure does as well with it, or it is
/// rejected. In a long recording it may have been tried in the prefix alone.
struct Rival {
  const Candidate* candidate = nullptr;
  double p = 1;     ///< of so steady a gain, by chance, from the term in the rival's place
  double lead = 0;  ///< in log-likelihood, of the term's structure over the rival's
};

/// The evidence for a term on manoeuvres that it was not fitted to.
struct TermEvidence {
  /// Probability of such a gain by chance (cross_fit.h, steady_gain.h), times the number of tests.
  double p = 1;
  double steady_p = 1;  ///< as p, by SteadyGainP alone
  /// As p, of this term and another one together, where each is needed beside the other only
  /// (pruning.h).
  std::optional<double> joint_p;
  /// Gain of the term on SELECT over that of the whole structure, or of the flexible regressor if
  /// that is more, over nothing.
  double share = 0;
  /// Gain of the term on SELECT over that of the flexible regressor over the structure without it.
  double share_of_rest = 0;
  double effect = 0;  ///< RMS of what it changes over the RMS of the channel, largest over channels
  /// Candidates with which in its place the structure is not significantly worse; itself first.
  std::vector<const Candidate*> rivals;
  std::vector<Rival> rejected;  ///< the other candidates that were tried, the nearest first
};

/// The evidence for a candidate by itself.
struct SingleEvidence {
  const Candidate* candidate = nullptr;
  std::vector<double> values;
  double gain = 0;           ///< in log-likelihood, on TRAIN
  double held_out_gain = 0;  ///< in log-likelihood, on SELECT
};

struct SearchResult {
  FittedStructure nothing, found;      ///< fitted to TRAIN and SELECT
  std::vector<TermEvidence> evidence;  ///< one for each term found
  std::vector<SingleEvidence> singles;
  double flexible_gain =
      0;  ///< in log-likelihood on SELECT, of the flexible regressor over nothing
  /// Gain in log-likelihood on SELECT of all that was found over nothing; none once a term was
  /// moved out.
  std::optional<double> found_gain;
};

/// An earlier search of the same block, from which a search goes on.
struct EarlierSearch {
  const SearchResult* result = nullptr;  ///< none: there was none
  /// The earlier search was of the block's prefix. Its terms are kept and added to without swaps,
  /// and its rejected rivals stay rejected. Else it was of the whole block, under other noise.
  bool of_prefix = false;
};

/// The search for the candidates that explain a block together.
///
/// Model   Forward: every candidate alone; pairs of the screened ones (the likeliest, and the
///         likeliest of each slot), of which the eight that are likeliest after a few steps are
///         fitted in full. Then, from the best single one, and from the best pair if that is
///         better, one term more at a time of at least `least_effect`, with swaps, four fitted in
///         full, as long as the Bayesian information criterion on TRAIN falls. Of structures that
///         are as likely, the one whose terms cancel each other less. Backward (pruning.h): a term
///         goes unless its gain over the structure fitted without it is steady over the manoeuvres
///         of TRAIN and SELECT, each left out of the fits that it judges (cross_fit.h,
///         steady_gain.h; Bonferroni over all that the diagnosis tests), and its share, share of
///         the rest and effect beyond nuisances are at least those of SearchOptions. It also goes
///         with numbers by which it is another mechanism in disguise (Candidate::is_itself). A
///         number that refines another one is put to its default where that changes less than
///         `least_effect`, one number after the other. Rivals (DiscriminateRivals): each term is
///         swapped for each screened candidate. Of the five that are likeliest after a few steps,
///         those are rivals over which the same manoeuvres do not gain from the term with p at most
///         kRivalP and at least kRivalGain.
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

/// RMS of the difference of two misfits over the RMS of the channel, the largest over channels.
double EffectOf(const ReplayBlock& block, const Misfit& with, const Misfit& without);

}  // namespace tera
