#pragma once

#include <optional>
#include <vector>

#include "core/random.h"
#include "diagnose/search/block/detectability.h"
#include "diagnose/search/block/locate.h"
#include "diagnose/search/block/residual_verdict.h"
#include "diagnose/search/block/testable.h"
#include "diagnose/search/fit/parameter_estimate.h"
#include "diagnose/search/structure/structure_search.h"

namespace tera {

/// The error of one channel before and after, on held-out samples, to which nothing was fitted and
/// by which nothing was chosen.
struct HeldOutError {
  std::size_t channel = 0;
  double rmse_before = 0, rmse_after = 0;
  double excess_removed = 0;  ///< share of the mean square above that of the noise
  /// Probability of such a gain by chance: for a finding over all channels together, by GainP where
  /// a bet counts and else by SteadyGainP; otherwise over this channel, by SteadyGainP.
  double p = 1;
};

/// What is left of a finding's channel on FINAL with all in its place that is as expected of its
/// target (MisfitOfExpectedInstead).
struct ErrorAsExpected {
  double rmse = 0;
  /// Standard deviation, by noise, of what the finding takes of its mean square: of twice the mean
  /// product of what is left with the finding and what the finding changes, by pieces of FINAL.
  double taken_sigma = 0;
};

/// A mechanism that was found to act.
struct Finding {
  Term term;
  std::vector<ParameterEstimate> parameters;
  TermEvidence evidence;
  Location location;      ///< of the error that is left without it alone
  HeldOutError held_out;  ///< before: without it; after: with it
  /// RMS on FINAL by which a factor at the end of its tolerance changes the channel of `held_out`,
  /// the largest of all factors; 0 where the block has none.
  double tolerated = 0;
  /// Of findings alone of whose numbers nothing is stated, or that have a rival with which all is
  /// as expected.
  std::optional<ErrorAsExpected> as_expected = {};
  bool is_confirmed = false;
};

/// The error on FINAL of a static map of the lever with a dead time (static_map.h), fitted to TRAIN
/// and SELECT. A model that is confirmed has less.
struct PlainComparison {
  double dead_time_s = 0, rmse = 0;
  bool is_better = false;  ///< steadily, than all that was found
};

/// The diagnosis of one block.
struct BlockDiagnosis {
  /// False where there are too few manoeuvres for a search (IsTestable): then only the manoeuvres,
  /// the noise and `search.nothing` are given.
  bool is_testable = true;
  /// The time limit of the whole diagnosis was reached before: then `is_testable` is false and
  /// nothing else is given.
  bool out_of_time = false;
  std::vector<Manoeuvre> manoeuvres;
  std::vector<NoiseModel> noise;
  SearchResult search;
  std::vector<Finding> findings;
  /// Mechanisms that were found and are as expected: their numbers are within tolerance.
  std::vector<Finding> within_tolerance;
  /// Mechanisms that were found on TRAIN and SELECT and that FINAL does not confirm.
  std::vector<Finding> unconfirmed;
  /// Mechanisms that come nearest to an error that stays unexplained, and are no name for it.
  std::vector<Finding> proxies;
  std::vector<Unexplained> unexplained;
  std::vector<ResidualVerdict> residual_verdicts;  ///< one for each channel
  std::vector<Detectability> detectability;        ///< one for each candidate
  std::vector<HeldOutError>
      confirmed;  ///< before: nothing; after: all findings; one for each channel
  /// A block with a lever and one channel has one. Where it is better nothing is confirmed.
  std::optional<PlainComparison> plain;
};

/// The block's manoeuvres, 3 s each at most, assigned to TRAIN, SELECT and FINAL.
std::vector<Manoeuvre> ManoeuvresOf(const ReplayBlock& block, const Stream& stream);

/// Diagnoses why a block's measurements differ from its replay: noise, search, location, residual
/// verdict, detectability, and the error on data that was not used.
///
/// Model   Noise and search in turn: what is found may have passed for noise at first. So noise is
///         estimated again beside it, and where a channel's noise then has less than half the
///         variance, or its innovations less than 0.7 of the scale, the search goes on from there,
///         twice at most.
///         Confirmation: FINAL must gain from a term steadily with p of at most 0.05. With p of at
///         most 0.2 it is confirmed too, if FINAL's RMSE falls and the term was chosen with p of at
///         most 1e-5, as steadily or so that nine tenths of FINAL's excess are gone. A term that is
///         worth a bet is also confirmed by three clear gains (AreConfirming) if FINAL's RMSE
///         falls. A term that was chosen by a bet alone must make FINAL's RMSE fall, and no term
///         may make it grow by more than an eighth. Proxies: in a channel that stays unexplained, a
///         finding is a proxy for something else where it has more than two rivals and removes less
///         than three quarters of the excess; where it removes less than a third and its channel is
///         the block's only one; or where it explains less than the flexible regressor still does,
///         and with that in its place FINAL's RMSE is less than half of what it is with the
///         finding. It is moved out if error is then still unexplained.
/// Omits   that a lesser mechanism may act beside something unknown and larger, and is then moved
///         out; that in a block of several channels a finding explains error in all of them, while
///         the flexible regressor is asked in one.
BlockDiagnosis DiagnoseBlock(const ReplayBlock& block, const SearchOptions& options,
                             const Stream& stream);

}  // namespace tera
