#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "diagnose/search/fit/likelihood.h"
#include "diagnose/statistics/series/manoeuvres.h"

namespace tera {

/// Gain of a second prediction over a first one in a manoeuvre or piece of it.
struct ManoeuvreGain {
  double gain = 0;
  double possible = 0;  ///< the gain if the second prediction were true and measured without noise
};

/// Gains of `after` over `before` in each manoeuvre, over all channels or one.
std::vector<ManoeuvreGain> GainsOf(const Likelihood& likelihood, const Misfit& before,
                                   const Misfit& after, const std::vector<Segment>& manoeuvres,
                                   std::optional<std::size_t> channel = {});

/// Cuts manoeuvres into equal pieces of at least one second and five samples. An error that lasts
/// longer than noise but shorter than a manoeuvre then counts once per piece.
std::vector<Segment> PiecesOf(const std::vector<Segment>& manoeuvres, double period_s);

/// p-value of a steady gain: a gain that recurs over manoeuvres or pieces of them.
///
/// Model   one-sided Student's t over one number per manoeuvre: gain / sqrt(possible (possible +
///         20)). It is 1 if a large difference is gained fully, and has a constant variance where
///         noise dominates. Errors as long as a manoeuvre count once. Manoeuvres with a possible
///         gain below 2 are ignored. p is 1 if fewer than three manoeuvres remain. Manoeuvres may
///         differ in variance: the test is then conservative for p below 0.08.
/// Omits   errors that outlast a manoeuvre or piece.
/// Source  Ibragimov and Mueller 2010, "t-statistic based correlation and heterogeneity robust
///         inference"; Bakirov and Szekely 2006.
double SteadyGainP(const std::vector<ManoeuvreGain>& gains);

/// p-value of a steady effect, under the hypothesis that there is none.
///
/// Model   SteadyGainP of gain + possible. This sum is the product of the first prediction's
///         residuals with the difference of both predictions, over the variance. Its mean is zero
///         without the effect, and twice the possible gain if the second prediction is true. The
///         gain itself has a negative mean without the effect. It detects only effects of at least
///         half the fitted size. Where a separate test requires that size, SteadyEffectP has more
///         power.
/// Omits   as SteadyGainP.
double SteadyEffectP(const std::vector<ManoeuvreGain>& gains);

/// p-value of a gain that is steady, or large in enough manoeuvres.
///
/// Model   the smaller of SteadyGainP and 2 / w. w is the wealth of a bet: at each manoeuvre all
///         wealth bets on the second prediction and is multiplied by the likelihood ratio, at most
///         exp(2.25). Suppose that the first prediction is true, with known noise and no fit to
///         these manoeuvres. Then each ratio, and w, has a mean of at most 1. Large w are therefore
///         rare (Markov's inequality). Taking the smaller of both makes p at most 1.5 times too
///         small. An effect in five of thirty pieces is no steady gain, but five clear gains
///         multiply w by 8e4. Manoeuvres with a possible gain below 2 do not take part in the bet.
/// Omits   the fit of noise and first prediction, and manoeuvres shared by cross-fits. Both make w
///         slightly too large; docs/evidence/proof.md counts the false alarms. Persistent errors of
///         the first prediction: each piece in which they favour the second one multiplies w, at
///         most by the factor above.
/// Source  Shafer 2021, "Testing by betting"; Vovk and Wang 2021, "E-values".
double GainP(const std::vector<ManoeuvreGain>& gains);

/// p up to which a steady gain on held-out manoeuvres confirms.
inline constexpr double kConfirmedP = 0.05;

/// True if held-out manoeuvres confirm a gain: steady with p up to `steady_level`, or clear in
/// three of them (GainP up to 0.01).
bool AreConfirming(const std::vector<ManoeuvreGain>& gains, double steady_level);

std::vector<Segment> SegmentsOf(const std::vector<Manoeuvre>& manoeuvres, Part part);

/// The manoeuvres of TRAIN and SELECT, in order.
std::vector<Segment> SeenSegmentsOf(const std::vector<Manoeuvre>& manoeuvres);

}  // namespace tera
