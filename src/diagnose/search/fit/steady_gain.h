#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "diagnose/search/fit/likelihood.h"
#include "diagnose/statistics/series/manoeuvres.h"

namespace tera {

/// The gain of one prediction over another in one manoeuvre, or a piece of one.
struct ManoeuvreGain {
  double gain = 0;      ///< in log-likelihood, of the second prediction over the first
  double possible = 0;  ///< the gain if the second were true and measured without noise
};

/// The gains of `after` over `before` in each manoeuvre, of one channel or of all together.
std::vector<ManoeuvreGain> GainsOf(const Likelihood& likelihood, const Misfit& before,
                                   const Misfit& after, const std::vector<Segment>& manoeuvres,
                                   std::optional<std::size_t> channel = {});

/// Cuts manoeuvres into equal pieces of a second or more, five samples at least. An error that
/// lasts longer than noise and shorter than a manoeuvre then counts once a piece.
std::vector<Segment> PiecesOf(const std::vector<Segment>& manoeuvres, double period_s);

/// The p-value of gains being as steady over manoeuvres, or pieces of them, by chance.
///
/// Model   one number a manoeuvre: its gain over sqrt(possible (possible + 20)), which is 1 where a
///         large difference is gained wholly, and has one variance where it drowns in noise.
///         Manoeuvres with a possible gain below 2 say nothing; with fewer than three others p is
///         1. One-sided Student's t: errors that last as long as a manoeuvre count once, and
///         manoeuvres may differ in their variance, for which the test is conservative at p below
///         0.08.
/// Omits   errors that outlast a manoeuvre, or a piece.
/// Source  Ibragimov and Mueller 2010, "t-statistic based correlation and heterogeneity robust
///         inference"; Bakirov and Szekely 2006.
double SteadyGainP(const std::vector<ManoeuvreGain>& gains);

/// The p-value of an effect showing as steadily by chance where there is none of it.
///
/// Model   SteadyGainP of gain + possible: that is the product of the first prediction's residuals
///         with the difference of both over the variance, nought on average where nothing is there,
///         and twice the possible gain where the second prediction is true. A gain alone is
///         expected to be negative where nothing is there, and asks for an effect of at least half
///         the fitted size: where that is required apart, this is the test with the power.
/// Omits   as SteadyGainP.
double SteadyEffectP(const std::vector<ManoeuvreGain>& gains);

/// The p-value of gains being as steady, or as large in as many manoeuvres, by chance.
///
/// Model   the smaller of SteadyGainP and of 2 / w, w the wealth of a bet: at each manoeuvre all of
///         it is put on the second prediction and multiplied by the ratio of likelihoods, nine and
///         a half (exp 2.25) at most. Were the first prediction true, noise
///         known and neither fitted to these manoeuvres, each ratio would be expected to be 1 at
///         most, and so w, which is then seldom large (Markov's inequality); with SteadyGainP
///         beside it, p is at most one and a half times too small. What acts in five of thirty
///         pieces is no steady gain, but five clear ones are worth 8e4 where the others say
///         nothing. Manoeuvres of which less than 2 is possible are no part of the bet.
/// Omits   that noise and the first prediction are themselves fitted, and of cross-fitted
///         manoeuvres that each was seen by the fits of the others, so that w is a little too
///         large: how often all of it finds something in nothing is counted
///         (docs/evidence/proof.md). Errors of the first prediction that last: each piece in which
///         they speak for the second counts, at most for such a factor.
/// Source  Shafer 2021, "Testing by betting"; Vovk and Wang 2021, "E-values".
double GainP(const std::vector<ManoeuvreGain>& gains);

/// Level of p at which a steady gain on manoeuvres that nothing was fitted to or chosen by
/// confirms.
inline constexpr double kConfirmedP = 0.05;

/// Whether such manoeuvres confirm a gain: it is steady at `steady_level`, or clear in three of
/// them (GainP of 0.01).
bool AreConfirming(const std::vector<ManoeuvreGain>& gains, double steady_level);

/// The samples of the manoeuvres of a part.
std::vector<Segment> SegmentsOf(const std::vector<Manoeuvre>& manoeuvres, Part part);

/// The samples of the manoeuvres of TRAIN and SELECT, in order.
std::vector<Segment> SeenSegmentsOf(const std::vector<Manoeuvre>& manoeuvres);

}  // namespace tera
