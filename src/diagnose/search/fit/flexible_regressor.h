#pragma once

#include "diagnose/search/fit/likelihood.h"
#include "diagnose/search/fit/replay_block.h"
#include "diagnose/statistics/series/manoeuvres.h"
#include "diagnose/statistics/series/noise_model.h"

namespace tera {

/// The residual of a misfit beyond what the channels' flexible regressors, fitted to TRAIN,
/// explain. A flexible regressor is a set of columns whose combinations come near to anything that
/// the physics of a block could do (Channel::flexible_regressor); what it gains bounds what a
/// mechanism can.
///
/// Model   for each channel, Huber regression (clip at 3 robust scales) of the whitened residual on
///         the whitened columns and a constant. The ridge, in parts of each column's energy, is the
///         one of a ladder that predicts best the TRAIN manoeuvres which a fit has not seen (five
///         folds). Where none predicts them better than zero does, the misfit is returned as it is.
/// Omits   choice among the columns: they are to be far fewer than the samples.
/// Source  Hoerl and Kennard 1970 (ridge regression); Huber 1964.
Misfit ResidualBeyondFlexible(const ReplayBlock& block, const Likelihood& likelihood,
                              const Misfit& misfit, const std::vector<Manoeuvre>& manoeuvres);

/// ResidualBeyondFlexible, cross-fitted: each manoeuvre, of whatever part, is judged by a fit to
/// the other four fifths of the manoeuvres.
///
/// Omits   that what outlasts a manoeuvre is seen in its neighbours.
/// Source  Chernozhukov et al. 2018, "Double/debiased machine learning" (cross-fitting).
Misfit CrossFittedResidual(const ReplayBlock& block, const Likelihood& likelihood,
                           const Misfit& misfit, const std::vector<Manoeuvre>& manoeuvres);

/// Noise of each channel: what a fit of the flexible regressor, beside what the block predicts with
/// the terms that were found so far, leaves of the measurements of TRAIN and SELECT. Of a mechanism
/// that is not among those terms, the part that the flexible regressor can follow does not count as
/// noise; the rest does.
///
/// Model   ridge of 1e-6, for this fit is not to predict; the scale is enlarged by the degrees of
///         freedom that the columns take. Innovations are at least 0.2 % of the channel's RMS,
///         since no replay is better.
std::vector<NoiseModel> NoiseOfBlock(const ReplayBlock& block,
                                     const std::vector<Manoeuvre>& manoeuvres,
                                     const Structure& found = {});

}  // namespace tera
