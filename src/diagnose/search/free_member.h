#pragma once

#include "diagnose/search/replay_block.h"
#include "diagnose/statistics/noise_model.h"

namespace tera {

/// What the free member of a channel leaves of a residual.
///
/// Model   Huber regression (clip 3 robust scales) of the whitened residual on the whitened columns
///         of the channel's free member and a constant, over the samples of `fit_on`, with a ridge
///         of 1e-6 of each column's energy.
/// Omits   choice among the columns: they are to be far fewer than the samples.
Series LessFreeMember(const Channel& channel, const Series& residual, const NoiseModel& noise,
                      const Mask& fit_on);

/// Noise of each channel: what a fit of the free member, together with what the block predicts
/// without any suspect, leaves of the measurements. No mechanism enters, so that none can hide in
/// it that the free member can follow. Innovations are at least 0.2 % of the channel's RMS: no
/// replay is better.
std::vector<NoiseModel> NoiseOfBlock(const ReplayBlock& block);

}  // namespace tera
