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

/// Error of one channel before and after, on FINAL: samples to which nothing is fitted and by which
/// nothing is chosen.
struct HeldOutError {
  std::size_t channel = 0;
  double rmse_before = 0, rmse_after = 0;
  double excess_removed = 0;  ///< share of the mean square above that of the noise
  /// p-value of the gain. A finding's gain is over all channels, by GainP where a bet may choose a
  /// term, else by SteadyGainP. Other gains are over this channel, by SteadyGainP.
  double p = 1;
};

/// Error of a finding's channel on FINAL, where the best hypothesis within tolerance replaces the
/// finding (MisfitOfExpectedInstead).
struct ErrorAsExpected {
  double rmse = 0;
  /// Standard deviation, by noise, of the reduction in mean square that the finding adds. It is
  /// that of twice the mean product of the finding's residual and the finding's change, over pieces
  /// of FINAL.
  double taken_sigma = 0;
};

/// A confirmed, unconfirmed or proxy mechanism with the evidence for it.
struct Finding {
  Term term;
  std::vector<ParameterEstimate> parameters;
  TermEvidence evidence;
  Location location;      ///< of the residual without this finding alone
  HeldOutError held_out;  ///< before: without the finding; after: with it
  /// Largest RMS on FINAL by which any rate factor at the end of its tolerance changes the channel
  /// of `held_out`. 0 if the block has no such factor.
  double tolerated = 0;
  /// Only for findings whose parameters all lack a stated tolerance, and for findings with a rival
  /// within tolerance.
  std::optional<ErrorAsExpected> as_expected = {};
  bool is_confirmed = false;
};

/// Error on FINAL of a dead time and a static map of the lever (static_map.h), fitted to TRAIN and
/// SELECT. Confirmed findings must have less.
struct PlainComparison {
  double dead_time_s = 0, rmse = 0;
  bool is_better = false;  ///< its error is steadily less than that of all findings together
};

struct BlockDiagnosis {
  /// False if there are too few manoeuvres for a search (IsTestable). Only the manoeuvres, the
  /// noise and `search.nothing` are then valid.
  bool is_testable = true;
  /// The diagnosis reached its time limit before this block. `is_testable` is then false and
  /// nothing else is valid.
  bool out_of_time = false;
  std::vector<Manoeuvre> manoeuvres;
  std::vector<NoiseModel> noise;
  SearchResult search;
  std::vector<Finding> findings;
  /// Mechanisms that act, with all parameters within tolerance.
  std::vector<Finding> within_tolerance;
  /// Mechanisms chosen on TRAIN and SELECT that FINAL does not confirm.
  std::vector<Finding> unconfirmed;
  /// Mechanisms that come nearest to an error that stays unexplained, but do not name its cause.
  std::vector<Finding> proxies;
  std::vector<Unexplained> unexplained;
  std::vector<ResidualVerdict> residual_verdicts;  ///< one for each channel
  std::vector<Detectability> detectability;        ///< one for each candidate
  std::vector<HeldOutError>
      confirmed;  ///< before: no term; after: all findings; one for each channel
  /// Only for a block with a lever and a single channel. If it is better, nothing is confirmed.
  std::optional<PlainComparison> plain;
};

/// Manoeuvres of the block, at most 3 s each, assigned to TRAIN, SELECT and FINAL.
std::vector<Manoeuvre> ManoeuvresOf(const ReplayBlock& block, const Stream& stream);

/// Diagnoses why a block's measurements differ from its replay: noise, search, location, residual
/// verdict, detectability, and held-out error.
///
/// Model   Noise and search alternate, since an error that no term explains yet can pass for noise
///         (search_with_noise.h).
///         Confirmation: FINAL confirms a term with a steady gain of p at most 0.05. A p of at most
///         0.2 suffices for a surely chosen term that lowers FINAL's RMSE. Its p of choice is at
///         most 1e-5, steadily, or otherwise with nine tenths of FINAL's excess removed. If a bet
///         may choose the term, three clear gains (AreConfirming) and a falling RMSE confirm it
///         too. A term chosen by a bet alone must lower FINAL's RMSE. No term may raise it by more
///         than an eighth.
///         Proxies: a finding is a proxy where its channel stays unexplained and one of three
///         conditions holds. It has more than two rivals and removes less than three quarters of
///         the excess. Its channel is the block's only one, and it removes less than a third. Or it
///         explains less than the flexible regressor still does, and the regressor in its place
///         leaves less than half of FINAL's RMSE. A proxy is moved out only if the channel is then
///         still unexplained.
/// Omits   a lesser mechanism that acts beside a larger unknown error: it counts as a proxy. The
///         flexible regressor is fitted to each channel, while a finding explains several.
BlockDiagnosis DiagnoseBlock(const ReplayBlock& block, const SearchOptions& options,
                             const Stream& stream);

}  // namespace tera
