#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "diagnose/search/fit/structure_fit.h"

/// What a search for structures is asked, and what it answers.

namespace tera {

/// A rival is rejected where the manoeuvres gain from the term in its place with p of at most
/// kRivalP and by at least kRivalGain of log-likelihood, below which there is nothing to choose by.
inline constexpr double kRivalP = 0.05, kRivalGain = 3;

inline constexpr std::size_t kMostStructureTerms = 8;  ///< in a structure
/// TermEvidence::share that a term must have.
inline constexpr double kLeastTermShare = 0.02;
/// TermEvidence::share that a term must have whose gain is clear by a bet and not steady.
inline constexpr double kLeastTermShareOfBet = 0.1;
/// TermEvidence::share_of_rest that a term must have.
inline constexpr double kLeastTermShareOfRest = 0.1;
/// TermEvidence::effect that a term must have.
inline constexpr double kLeastTermEffect = 0.02;

struct SearchOptions {
  double alpha = 0.01;  ///< probability of any term where nothing acts, all tests together
  /// Candidates that the whole diagnosis tests, and channels whose residuals it judges: what
  /// p-values are corrected for. 0: those of the block alone.
  std::size_t total_candidates = 0, total_channels = 0;
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
  /// The p of this term and another one together, where each is needed beside the other only
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
  /// Those of the rivals with which all is as expected that is as expected beside the term.
  std::vector<const Candidate*> expected_rivals;
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
  FittedStructure nothing, found;  ///< fitted to TRAIN and SELECT
  /// The structure before unneeded terms left it. Noise is estimated anew beside it.
  Structure fullest;
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

}  // namespace tera
