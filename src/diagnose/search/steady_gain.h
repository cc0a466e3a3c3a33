#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "diagnose/search/likelihood.h"
#include "diagnose/statistics/manoeuvres.h"

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

/// The samples of the manoeuvres of a part.
std::vector<Segment> SegmentsOf(const std::vector<Manoeuvre>& manoeuvres, Part part);

/// The samples of the manoeuvres of TRAIN and SELECT, in order.
std::vector<Segment> SeenSegmentsOf(const std::vector<Manoeuvre>& manoeuvres);

}  // namespace tera
