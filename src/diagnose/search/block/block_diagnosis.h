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

/// Error of one channel on FINAL, before and after. No fit and no choice uses FINAL.
struct HeldOutError {
  std::size_t channel = 0;
  double rmse_before = 0, rmse_after = 0;
  double excess_removed = 0;  ///< share of the mean square beyond noise
  /// p-value of the gain. For a finding: over all channels, by GainP where the finding improves
  /// FINAL and its share is at least kLeastTermShareOfBet, else by SteadyGainP. Otherwise: over
  /// this channel, by SteadyGainP.
  double p = 1;
};

/// Error of a finding's channel on FINAL where the best explanation within tolerance replaces the
/// finding (MisfitOfExpectedInstead).
struct ErrorAsExpected {
  double rmse = 0;
  /// Standard deviation, due to noise, of the additional reduction in mean square by the finding.
  /// It comes from the products of the finding's residual with the change by the finding, summed
  /// over each piece of FINAL.
  double taken_sigma = 0;
};

/// A mechanism with its evidence: confirmed, unconfirmed or a proxy.
struct Finding {
  Term term;
  std::vector<ParameterEstimate> parameters;
  TermEvidence evidence;
  Location location;      ///< where the error occurs that remains without this finding
  HeldOutError held_out;  ///< before: without this finding; after: with it
  /// Largest RMS change on FINAL, in the channel of `held_out`, by a rate factor at the end of its
  /// tolerance. 0 if the block has no rate factor.
  double tolerated = 0;
  /// Set where no parameter of the finding has a stated tolerance, or where a rival is within
  /// tolerance.
  std::optional<ErrorAsExpected> as_expected = {};
  bool is_confirmed = false;
};

/// Comparison with a dead time and a static map of the lever (static_map.h), fitted to TRAIN and
/// SELECT and evaluated on FINAL.
struct PlainComparison {
  double dead_time_s = 0, rmse = 0;
  bool is_better = false;  ///< significantly smaller error than all findings together
};

struct BlockDiagnosis {
  /// False if there are too few manoeuvres for a search (IsTestable). Only the manoeuvres, the
  /// noise and `search.nothing` are then valid.
  bool is_testable = true;
  /// True if the time limit ended the diagnosis before this block. `is_testable` is then false and
  /// nothing else is valid.
  bool out_of_time = false;
  std::vector<Manoeuvre> manoeuvres;
  std::vector<NoiseModel> noise;
  SearchResult search;
  std::vector<Finding> findings;
  /// Mechanisms that act within their tolerances.
  std::vector<Finding> within_tolerance;
  /// Mechanisms chosen on TRAIN and SELECT that FINAL does not confirm.
  std::vector<Finding> unconfirmed;
  /// Mechanisms that come nearest to an unexplained error, but are not its cause.
  std::vector<Finding> proxies;
  std::vector<Unexplained> unexplained;
  std::vector<ResidualVerdict> residual_verdicts;  ///< one per channel
  std::vector<Detectability> detectability;        ///< one per candidate
  std::vector<HeldOutError> confirmed;  ///< one per channel; before: no term; after: all findings
  /// For blocks with one channel and readings of its chain (ReplayBlock::read_whole). If the plain
  /// map is better, no finding is confirmed.
  std::optional<PlainComparison> plain;
};

/// Manoeuvres of the block, at most 3 s each, assigned to TRAIN, SELECT and FINAL.
std::vector<Manoeuvre> ManoeuvresOf(const ReplayBlock& block, const Stream& stream);

/// Diagnoses why a block's measurements differ from its replay.
///
/// Model   Noise estimation and search alternate, because an unexplained error can pass for noise
///         (search_with_noise.h).
///
///         FINAL confirms a term by one of three rules. A: the steady gain has p at most 0.05. B: p
///         is at most 0.2, the term is surely chosen, and it lowers FINAL's RMSE. Surely chosen
///         means a p of choice of at most 1e-5 by SteadyGainP, or by GainP if nine tenths of
///         FINAL's excess is removed. C: the term lowers FINAL's RMSE, its share is at least
///         kLeastTermShareOfBet, and the gain is clear in three pieces (AreConfirming). A term
///         whose steady gain was not significant in the search must lower FINAL's RMSE in any case.
///         No term may raise FINAL's RMSE by more than an eighth.
///
///         A finding is a proxy if its channel stays unexplained and one of three conditions holds.
///         A: it has more than two rivals and removes less than three quarters of the excess. B:
///         its channel is the only one of the block, and it removes less than a third of the
///         excess. C: it explains less than the flexible regressor still does, and the regressor in
///         its place leaves less than half of the RMSE on FINAL. A proxy is moved out only if its
///         channel then stays unexplained.
/// Omits   a lesser mechanism beside a larger unknown error, which counts as a proxy. The flexible
///         regressor is fitted to each channel, while a finding explains several.
BlockDiagnosis DiagnoseBlock(const ReplayBlock& block, const SearchOptions& options,
                             const Stream& stream);

}  // namespace tera
