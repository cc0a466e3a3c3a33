#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "diagnose/search/fit/structure_fit.h"

/// Options and result of a search for structures.

namespace tera {

/// A rival is rejected if the manoeuvres gain from the term in its place with p at most kRivalP and
/// at least kRivalGain of log-likelihood. Smaller gains do not discriminate.
inline constexpr double kRivalP = 0.05, kRivalGain = 3;

inline constexpr std::size_t kMostStructureTerms = 8;
/// Least TermEvidence::share of a needed term.
inline constexpr double kLeastTermShare = 0.02;
/// Least TermEvidence::share of a term whose gain is clear by a bet but not steady.
inline constexpr double kLeastTermShareOfBet = 0.1;
/// Least TermEvidence::share_of_rest of a needed term.
inline constexpr double kLeastTermShareOfRest = 0.1;
/// Least TermEvidence::effect of a needed term.
inline constexpr double kLeastTermEffect = 0.02;

struct SearchOptions {
  double alpha = 0.01;  ///< probability of any term if none acts, over all tests
  /// Numbers of candidates and of judged channels in the whole diagnosis, by which p-values are
  /// corrected. 0: those of the block alone.
  std::size_t total_candidates = 0, total_channels = 0;
  int threads = 2;
};

/// A candidate tried in a term's place. It is either rejected, or explains the measurements as
/// well. In a long recording it may have been tried in the prefix only.
struct Rival {
  const Candidate* candidate = nullptr;
  double p = 1;     ///< p-value of the term's steady gain over the rival
  double lead = 0;  ///< gain in log-likelihood of the term's structure over the rival's
};

/// Evidence for a term, from manoeuvres outside its fit.
struct TermEvidence {
  /// p-value of the gain (cross_fit.h, steady_gain.h), times the number of tests.
  double p = 1;
  double steady_p = 1;  ///< as p, by SteadyGainP alone
  /// p-value of this term together with another, if each is needed only with the other (pruning.h).
  std::optional<double> joint_p;
  /// Gain of the term on SELECT, relative to the gain over the empty structure by the whole
  /// structure or by the flexible regressor, whichever is larger.
  double share = 0;
  /// Gain of the term on SELECT, relative to the flexible regressor's gain over the structure
  /// without it.
  double share_of_rest = 0;
  double effect = 0;  ///< RMS of its change over the channel's RMS, the largest over channels
  /// Candidates with which the structure is not significantly worse; the term's own first.
  std::vector<const Candidate*> rivals;
  /// Rivals that are within tolerance and keep within tolerance the terms that were.
  std::vector<const Candidate*> expected_rivals;
  std::vector<Rival> rejected;  ///< the other candidates tried, the nearest first
};

/// Evidence for a candidate alone.
struct SingleEvidence {
  const Candidate* candidate = nullptr;
  std::vector<double> values;
  double gain = 0;           ///< in log-likelihood, on TRAIN
  double held_out_gain = 0;  ///< in log-likelihood, on SELECT
};

struct SearchResult {
  FittedStructure nothing, found;  ///< fitted to TRAIN and SELECT
  /// The structure before pruning, used for the next estimate of the noise.
  Structure fullest;
  std::vector<TermEvidence> evidence;  ///< one for each found term
  std::vector<SingleEvidence> singles;
  double flexible_gain =
      0;  ///< in log-likelihood on SELECT, of the flexible regressor over the empty structure
  /// Gain in log-likelihood on SELECT of all found terms over the empty structure; none after a
  /// term was moved out.
  std::optional<double> found_gain;
};

/// An earlier search of the same block, from which a search continues.
struct EarlierSearch {
  const SearchResult* result = nullptr;  ///< null: there was none
  /// True: the earlier search covered the block's prefix. Its terms are kept and extended without
  /// swaps, and its rejected rivals stay rejected. False: it covered the whole block under other
  /// noise.
  bool of_prefix = false;
};

}  // namespace tera
