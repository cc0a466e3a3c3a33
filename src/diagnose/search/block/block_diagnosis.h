#pragma once

#include <vector>

#include "core/random.h"
#include "diagnose/search/block/detectability.h"
#include "diagnose/search/block/locate.h"
#include "diagnose/search/block/residual_verdict.h"
#include "diagnose/search/fit/parameter_estimate.h"
#include "diagnose/search/structure/structure_search.h"

namespace tera {

/// One channel before and after, on samples that nothing was fitted to or chosen by.
struct HeldOutError {
  std::size_t channel = 0;
  double rmse_before = 0, rmse_after = 0;
  double excess_removed = 0;  ///< of the mean square above that of the noise
  /// Of such a gain by chance (GainP for a finding of which a bet counts, else SteadyGainP): of a
  /// finding, all channels together; else this one's.
  double p = 1;
};

/// A mechanism that acts.
struct Finding {
  Term term;
  std::vector<ParameterEstimate> parameters;
  TermEvidence evidence;
  Location location;      ///< of the error that it leaves if it alone is left out
  HeldOutError held_out;  ///< without it, and with it
  bool is_confirmed = false;
};

struct BlockDiagnosis {
  /// False where SELECT or FINAL have so few manoeuvres that nothing could be found: then only the
  /// manoeuvres, the noise and `search.nothing` are given.
  bool is_testable = true;
  /// The time of the whole diagnosis was over first: not testable, and nothing else is given.
  bool out_of_time = false;
  std::vector<Manoeuvre> manoeuvres;
  std::vector<NoiseModel> noise;
  SearchResult search;
  std::vector<Finding> findings;
  /// What was found on TRAIN and SELECT and did not make FINAL any better.
  std::vector<Finding> unconfirmed;
  /// Mechanisms that come nearest to an error that stays unexplained, and are no name for it.
  std::vector<Finding> proxies;
  std::vector<Unexplained> unexplained;
  std::vector<ResidualVerdict> residual_verdicts;  ///< one a channel
  std::vector<Detectability> detectability;        ///< one a candidate
  std::vector<HeldOutError> confirmed;             ///< nothing against all findings, one a channel
};

/// The block's manoeuvres, 3 s at most each, shared out among TRAIN, SELECT and FINAL.
std::vector<Manoeuvre> ManoeuvresOf(const ReplayBlock& block, const Stream& stream);

/// Whether enough manoeuvres were commanded for findings to be chosen and confirmed: six of TRAIN
/// and SELECT, three of FINAL.
bool IsTestable(const std::vector<Manoeuvre>& manoeuvres);

/// Says why a block's measurements differ from its replay: noise, search, location, what remains,
/// what could not have been seen, and the error on data that was not used.
///
/// Model   noise and search in turn: what was found may have passed for noise at first, so noise is
///         estimated again beside it, and where a channel's then has less than half the variance,
///         or its innovations less than 0.7 of the scale, the search goes on from there, twice at
///         most. A term stays if FINAL gains from it steadily with p of at most 0.05, or 0.2 if it
///         was chosen with p of at most 1e-5, as steadily or so that nine tenths of FINAL's excess
///         are gone, and FINAL's RMSE falls; or by three clear gains (AreConfirming), if it is
///         worth a bet and FINAL's RMSE falls; what was chosen by a bet alone makes it fall in any
///         case, and nothing makes it grow by more than an eighth. What remains:
///         residual_verdict.h. In a channel that stays unexplained a finding is a proxy for
///         something else where it is not told from more than two others and removes less than
///         three quarters of the excess, where it removes less than a third and is its block's only
///         channel, or where it explains less than the flexible regressor still does, and with that
///         in its place FINAL's RMSE is less than half of what it is with the finding. It is taken
///         out again, if error is then still unexplained.
/// Omits   that a lesser mechanism may be there beside something unknown and larger, and is then
///         taken out; that in a block of several channels a finding explains in all of them, and
///         the flexible regressor is asked in one.
BlockDiagnosis DiagnoseBlock(const ReplayBlock& block, const SearchOptions& options,
                             const Stream& stream);

}  // namespace tera
