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
  std::size_t deepest = 4;   ///< terms in a structure
  double alpha = 0.01;       ///< probability of a term where there is none, all tests together
  /// Candidates that the whole diagnosis tests, and channels whose residuals it judges: what
  /// p-values are corrected for. 0: those of the block alone.
  std::size_t total_candidates = 0, total_channels = 0;
  double least_share = 0.02;        ///< of all that was found on SELECT, that a term must explain
  double least_share_of_bet = 0.1;  ///< likewise, by a gain that is clear and not steady
  double least_of_rest = 0.1;       ///< of what the others leave, that a term must explain
  double least_effect = 0.02;       ///< RMS of what a term changes over the RMS of the channel
  int threads = 2;
};

/// What stands in a term's place no worse, or was tried there in vain; in the prefix of a block,
/// by what that says.
struct Rival {
  const Candidate* candidate = nullptr;
  double p = 1;     ///< of a gain so steady by chance from the term in the rival's place
  double lead = 0;  ///< of the term's structure in log-likelihood, over the same manoeuvres
};

/// How a term stands on manoeuvres that it was not fitted to.
struct TermEvidence {
  double p =
      1;  ///< of such a gain by chance (cross_fit.h, steady_gain.h), times the number of tests
  double steady_p = 1;  ///< the same by SteadyGainP alone
  /// Of it and another one, where both are needed beside each other only (pruning.h).
  std::optional<double> together_p;
  double share =
      0;  ///< of the gain in likelihood on SELECT that the flexible regressor has over nothing
  double of_rest =
      0;  ///< of the gain that the flexible regressor has over the structure without the term
  double effect = 0;  ///< RMS of what it changes over the RMS of the channel, largest over channels
  /// Candidates in whose place the structure is not significantly worse, itself first.
  std::vector<const Candidate*> rivals;
  std::vector<Rival> rejected;  ///< the others that were tried, the nearest first
};

/// A candidate alone.
struct SingleEvidence {
  const Candidate* candidate = nullptr;
  std::vector<double> values;
  double gain = 0;           ///< of log-likelihood on TRAIN
  double held_out_gain = 0;  ///< on SELECT
};

struct SearchResult {
  FittedStructure nothing, found;      ///< fitted to TRAIN and SELECT
  std::vector<TermEvidence> evidence;  ///< one for each term found
  std::vector<SingleEvidence> singles;
  double flexible_gain =
      0;  ///< held-out gain in log-likelihood of the flexible regressor over nothing
  std::optional<double> found_gain;  ///< of all that was found; none where some was taken out
};

/// A search of the same block that came before.
struct EarlierSearch {
  const SearchResult* result = nullptr;  ///< none: there was none
  /// Of the block's prefix: what was exchanged and told apart there is not again, and what was
  /// found is only added to. Else of all of it, under other noise.
  bool of_prefix = false;
};

/// The search for the candidates that explain a block, together.
///
/// Model   every candidate alone; pairs of the screened (the likeliest, and the likeliest of each
///         slot), of which a few steps of each fit tell the eight that are fitted in full; then,
///         from the best single one and from the best pair if that is better, likewise, of four,
///         one term more at a time, of at least `least_effect`, with swaps, as long as the Bayesian
///         information criterion on TRAIN falls; of structures that are as likely, the one whose
///         terms undo each other less. Backward (but see pruning.h): a term goes unless its gain
///         over the structure fitted without it is steady over the manoeuvres of TRAIN and SELECT,
///         each left out of the fits that it judges (cross_fit.h, steady_gain.h; Bonferroni over
///         all that the diagnosis tests), on SELECT at least `least_share` of what the whole
///         structure, or a flexible regressor if that is more, gains over nothing and at least
///         `least_of_rest` of what a flexible regressor gains over the structure without it, and
///         its effect, beyond nuisances, at least `least_effect` of the channel. It goes, too, with
///         numbers by which it is another mechanism in disguise (Candidate::is_itself). What
///         refines a number is put to its default in the answer where that, one number after the
///         other, changes less than `least_effect`. DiscriminateRivals: each term is swapped for
///         each screened candidate; of the five that a few steps make likeliest, where the same
///         manoeuvres do not gain from the term with p at most 0.05, or less than 3 of
///         log-likelihood, they are alike.
/// Omits   that the structures whose terms are tested were chosen on part of the same manoeuvres,
///         beyond the number of candidates; FINAL is for that.
/// Source  Schwarz 1978.
class StructureSearch {
 public:
  /// `noise` of each channel; `on_seen` fits to TRAIN and SELECT. A search after an earlier one
  /// begins where that ended: single candidates with the numbers that they had there, the likeliest
  /// four fitted anew where nothing was found, and what was found instead of pairs. All but the
  /// noise must outlive it and stay as they are.
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

/// RMS of what one misfit differs from another by, over the RMS of the channel; the largest.
double EffectOf(const ReplayBlock& block, const Misfit& with, const Misfit& without);

}  // namespace tera
