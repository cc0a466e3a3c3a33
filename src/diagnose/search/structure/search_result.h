#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "diagnose/search/fit/structure_fit.h"

namespace tera {

/// A rival is rejected if the term gains at least kRivalGain of log-likelihood over it, with p up
/// to kRivalP.
inline constexpr double kRivalP = 0.05, kRivalGain = 3;

inline constexpr std::size_t kMostStructureTerms = 8;
/// Smallest TermEvidence::share of a needed term.
inline constexpr double kLeastTermShare = 0.02;
/// Smallest TermEvidence::share of a term that GainP may confirm where SteadyGainP does not.
inline constexpr double kLeastTermShareOfBet = 0.1;
/// Smallest TermEvidence::share_of_rest of a needed term.
inline constexpr double kLeastTermShareOfRest = 0.1;
/// Smallest TermEvidence::effect of a needed term.
inline constexpr double kLeastTermEffect = 0.02;

struct SearchOptions {
  double alpha = 0.01;  ///< probability of finding any term where none acts
  /// Candidates and judged channels of the whole diagnosis, for the correction of p-values. 0:
  /// those of the block.
  std::size_t total_candidates = 0, total_channels = 0;
  int threads = 2;
};

/// A candidate that was tried in place of a term. In a long recording it may have been tried in the
/// prefix only.
struct Rival {
  const Candidate* candidate = nullptr;
  double p = 1;     ///< p-value of the steady gain of the term over the rival
  double lead = 0;  ///< gain in log-likelihood of the term's structure over the rival's
};

/// Evidence for a term from manoeuvres that its fit did not use.
struct TermEvidence {
  /// p-value of the gain (cross_fit.h, steady_gain.h), corrected for the number of tests. GainP
  /// where `share` is at least kLeastTermShareOfBet, else SteadyGainP.
  double p = 1;
  double steady_p = 1;  ///< always by SteadyGainP
  /// p-value of this term together with another, where each is needed only with the other
  /// (pruning.h).
  std::optional<double> joint_p;
  /// Gain of the term on SELECT over that of the whole structure or of the flexible regressor,
  /// whichever is larger. Both are relative to the empty structure.
  double share = 0;
  /// Gain of the term on SELECT over that of the flexible regressor, both relative to the structure
  /// without the term.
  double share_of_rest = 0;
  double effect = 0;  ///< RMS change by the term over the channel's RMS; the largest over channels
  /// The term's own candidate, then the candidates that explain the data about as well in its
  /// place.
  std::vector<const Candidate*> rivals;
  /// Rivals that are within tolerance, and in whose structure all terms that were within tolerance
  /// stay there.
  std::vector<const Candidate*> expected_rivals;
  std::vector<Rival> rejected;  ///< nearest first
};

/// Evidence for a candidate as the only term.
struct SingleEvidence {
  const Candidate* candidate = nullptr;
  std::vector<double> values;
  double gain = 0;           ///< gain in log-likelihood on TRAIN
  double held_out_gain = 0;  ///< gain in log-likelihood on SELECT
};

struct SearchResult {
  FittedStructure nothing, found;  ///< fitted to TRAIN and SELECT
  /// The structure before pruning, for the next estimate of the noise.
  Structure fullest;
  std::vector<TermEvidence> evidence;  ///< one per term of `found`
  std::vector<SingleEvidence> singles;
  /// Gain of the flexible regressor over the empty structure, in log-likelihood on SELECT.
  double flexible_gain = 0;
  /// Gain of all found terms over the empty structure, in log-likelihood on SELECT. Empty after a
  /// term was moved out.
  std::optional<double> found_gain;
};

/// An earlier search of the same block that a search continues.
struct EarlierSearch {
  const SearchResult* result = nullptr;  ///< null without an earlier search
  /// True: the earlier search covered a prefix of the block. Its terms are kept and extended
  /// without swaps, and its rejected rivals stay rejected. False: it covered the whole block under
  /// other noise.
  bool of_prefix = false;
};

}  // namespace tera
