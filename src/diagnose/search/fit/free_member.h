#pragma once

#include "diagnose/search/fit/likelihood.h"
#include "diagnose/search/fit/replay_block.h"
#include "diagnose/statistics/series/manoeuvres.h"
#include "diagnose/statistics/series/noise_model.h"

namespace tera {

/// A misfit less what the channels' free members, fitted to TRAIN, explain of it.
///
/// Model   for each channel, Huber regression (clip 3 robust scales) of the whitened residual on
///         the whitened columns of its free member and a constant. The ridge, in parts of each
///         column's energy, is the one of a ladder that predicts TRAIN manoeuvres best which the
///         fit has not seen (five folds); where none predicts them better than nothing does, the
///         misfit is left as it is.
/// Omits   choice among the columns: they are to be far fewer than the samples.
Misfit LessFreeMember(const ReplayBlock& block, const Likelihood& likelihood, const Misfit& misfit,
                      const std::vector<Manoeuvre>& manoeuvres);

/// The same, each manoeuvre, of whatever part, less a fit to others: every fifth is left out of
/// one.
///
/// Omits   that what outlasts a manoeuvre is seen in its neighbours.
Misfit LessUnseenFreeMember(const ReplayBlock& block, const Likelihood& likelihood,
                            const Misfit& misfit, const std::vector<Manoeuvre>& manoeuvres);

/// Noise of each channel: what a fit of the free member, together with what the block predicts
/// with the terms that were found so far, leaves of the measurements of TRAIN and SELECT. What of a
/// mechanism that is not among them the free member can follow does not count as noise, the rest
/// does.
///
/// Model   ridge 1e-6, for what is fitted here is not to predict; the scale is enlarged by the
///         degrees of freedom that the columns take. Innovations are at least 0.2 % of the
///         channel's RMS: no replay is better.
std::vector<NoiseModel> NoiseOfBlock(const ReplayBlock& block,
                                     const std::vector<Manoeuvre>& manoeuvres,
                                     const Structure& found = {});

}  // namespace tera
