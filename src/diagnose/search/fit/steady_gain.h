#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "diagnose/search/fit/likelihood.h"
#include "diagnose/statistics/series/manoeuvres.h"

namespace tera {

/// Gain of one prediction over another in a manoeuvre or a piece of it.
struct ManoeuvreGain {
  double gain = 0;      ///< in log-likelihood, of the second prediction over the first
  double possible = 0;  ///< the gain if the second were true and measured without noise
};

/// Gains of `after` over `before` in each manoeuvre, over all channels or one.
std::vector<ManoeuvreGain> GainsOf(const Likelihood& likelihood, const Misfit& before,
                                   const Misfit& after, const std::vector<Segment>& manoeuvres,
                                   std::optional<std::size_t> channel = {});

/// Cuts manoeuvres into equal pieces of at least a second and five samples. An error longer than
/// noise and shorter than a manoeuvre then counts once in each piece.
std::vector<Segment> PiecesOf(const std::vector<Segment>& manoeuvres, double period_s);

/// p-value of a steady gain: gains that recur over manoeuvres, or pieces of them.
///
/// Model   each manoeuvre gives one number, its gain over sqrt(possible (possible + 20)). The
///         number is 1 if a large difference is gained wholly, and has a constant variance if noise
///         dominates. Manoeuvres with a possible gain below 2 are ignored; p is 1 with fewer than
///         three others. One-sided Student's t: errors as long as a manoeuvre count once.
///         Manoeuvres may differ in variance, for which the test is conservative at p below 0.08.
/// Omits   errors that outlast a manoeuvre or piece.
/// Source  Ibragimov and Mueller 2010, "t-statistic based correlation and heterogeneity robust
///         inference"; Bakirov and Szekely 2006.
double SteadyGainP(const std::vector<ManoeuvreGain>& gains);

/// p-value of a steady effect, under the hypothesis that there is none.
///
/// Model   SteadyGainP of gain + possible. The sum is the product of the first prediction's
///         residuals with the difference of both predictions, over the variance. Its mean is zero
///         without the effect, and twice the possible gain if the second prediction is true. The
///         gain itself has a negative mean without the effect, and detects only half the fitted
///         size or more. Where a separate test requires that size, this one has the greater power.
/// Omits   as SteadyGainP.
double SteadyEffectP(const std::vector<ManoeuvreGain>& gains);

/// p-value of gains that are steady, or large in enough manoeuvres.
///
/// Model   the smaller of SteadyGainP and 2 / w, with w the wealth of a bet. At each manoeuvre the
///         whole wealth bets on the second prediction and is multiplied by the likelihood ratio, at
///         most exp(2.25). If the first prediction is true, with known noise and no fit to these
///         manoeuvres, each ratio has a mean of at most 1. So has w, which is then seldom large
///         (Markov's inequality). The minimum with SteadyGainP makes p at most one and a half times
///         too small. An effect in five of thirty pieces is no steady gain, but five clear gains
///         multiply w by 8e4. Manoeuvres with a possible gain below 2 do not take part in the bet.
/// Omits   that noise and first prediction are fitted, and that cross-fits share manoeuvres, which
///         makes w slightly too large; docs/evidence/proof.md counts the false alarms. Persistent
///         errors of the first prediction: each piece in which they favour the second counts, with
///         at most the factor above.
/// Source  Shafer 2021, "Testing by betting"; Vovk and Wang 2021, "E-values".
double GainP(const std::vector<ManoeuvreGain>& gains);

/// Level of p at which a steady gain on held-out manoeuvres confirms.
inline constexpr double kConfirmedP = 0.05;

/// Whether held-out manoeuvres confirm a gain: steady at `steady_level`, or clear in three of them
/// (GainP of 0.01).
bool AreConfirming(const std::vector<ManoeuvreGain>& gains, double steady_level);

std::vector<Segment> SegmentsOf(const std::vector<Manoeuvre>& manoeuvres, Part part);

/// The samples of TRAIN's and SELECT's manoeuvres, in order.
std::vector<Segment> SeenSegmentsOf(const std::vector<Manoeuvre>& manoeuvres);

}  // namespace tera
