#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "diagnose/search/fit/likelihood.h"
#include "diagnose/statistics/series/manoeuvres.h"

namespace tera {

/// What one manoeuvre, or a piece of one, says of two predictions.
struct ManoeuvreGain {
  double gain = 0;      ///< of log-likelihood, of the second over the first
  double possible = 0;  ///< the same were the second true and there no noise
};

/// One channel's, or that of all together.
std::vector<ManoeuvreGain> GainsOf(const Likelihood& likelihood, const Misfit& before,
                                   const Misfit& after, const std::vector<Segment>& manoeuvres,
                                   std::optional<std::size_t> channel = {});

/// Manoeuvres in equal pieces of a second or more, five samples at least: what lasts longer than
/// noise and shorter than a manoeuvre counts once a piece.
std::vector<Segment> PiecesOf(const std::vector<Segment>& manoeuvres, double period_s);

/// Probability, by chance, of gains as steady over manoeuvres, or pieces of them, as these.
///
/// Model   one number a manoeuvre: its gain over sqrt(possible (possible + 20)), which is 1 where a
///         large difference is all gained, and of one variance where it drowns in noise.
///         Manoeuvres of which less than 2 is possible say nothing; fewer than three that do leave
///         p at 1. Student's t, one-sided: errors that last as long as a manoeuvre count once, and
///         manoeuvres may differ in how sure they are: for p below 0.08 the test is then
///         conservative.
/// Omits   errors that outlast a manoeuvre, or a piece.
/// Source  Ibragimov and Mueller 2010, "t-statistic based correlation and heterogeneity robust
///         inference"; Bakirov and Szekely 2006.
double SteadyGainP(const std::vector<ManoeuvreGain>& gains);

/// Probability, by chance, of gains as steady as these, or as large in as many manoeuvres.
///
/// Model   the smaller of SteadyGainP and of 2 / w, w the worth of a bet: with each manoeuvre all
///         that there is is put on the second prediction and multiplied by the ratio of
///         likelihoods, nine and a half (exp 2.25) at most. Were the first prediction true, noise
///         known and neither fitted to these manoeuvres, each ratio would be expected to be 1 at
///         most, and so w, which is then seldom large (Markov's inequality); with SteadyGainP
///         beside it, p is at most one and a half times too small. What acts in five of thirty
///         pieces is no steady gain, but five clear ones are worth 8e4 where the others say
///         nothing. Manoeuvres of which less than 2 is possible are no part of the bet.
/// Omits   that noise and the first prediction are themselves fitted, and of cross-fitted
///         manoeuvres that each was seen by the fits of the others, so that w is a little too
///         large: how often all of it finds something in nothing is counted (docs/proof.md). Errors
///         of the first prediction that last: each piece in which they speak for the second counts,
///         at most for such a factor.
/// Source  Shafer 2021, "Testing by betting"; Vovk and Wang 2021, "E-values".
double GainP(const std::vector<ManoeuvreGain>& gains);

/// Of what is steady on manoeuvres that nothing was fitted to or chosen by.
inline constexpr double kConfirmedP = 0.05;

/// Whether such manoeuvres confirm a gain: steady at this level, or three clear ones (GainP at
/// 0.01).
bool AreConfirming(const std::vector<ManoeuvreGain>& gains, double steady_level);

/// The samples of the manoeuvres of a part.
std::vector<Segment> SegmentsOf(const std::vector<Manoeuvre>& manoeuvres, Part part);

/// The samples of the manoeuvres of TRAIN and SELECT, in order.
std::vector<Segment> SeenSegmentsOf(const std::vector<Manoeuvre>& manoeuvres);

}  // namespace tera
