#pragma once

#include "diagnose/search/fit/likelihood.h"
#include "diagnose/search/fit/replay_block.h"
#include "diagnose/statistics/series/manoeuvres.h"
#include "diagnose/statistics/series/noise_model.h"

namespace tera {

/// The residual after the channels' flexible regressors, fitted to TRAIN. A flexible regressor is a
/// set of columns whose combinations approximate anything that the physics of a block could do
/// (Channel::flexible_regressor). Its gain in log-likelihood is an upper bound of the gain by any
/// mechanism.
///
/// Model   for each channel, Huber regression (clip at 3 robust scales) of the whitened residual on
///         the whitened columns and a constant. Ridges are relative to the energy of each column.
///         The chosen ridge predicts TRAIN manoeuvres outside its fit best (five folds). If no
///         ridge predicts better than zero, the misfit is returned unchanged.
/// Omits   selection of columns: they must be far fewer than the samples.
/// Source  Hoerl and Kennard 1970 (ridge regression); Huber 1964.
Misfit ResidualBeyondFlexible(const ReplayBlock& block, const Likelihood& likelihood,
                              const Misfit& misfit, const std::vector<Manoeuvre>& manoeuvres);

/// ResidualBeyondFlexible with cross-fitting: each manoeuvre of any part is judged by a fit to four
/// fifths of the manoeuvres that do not contain it.
///
/// Omits   effects that outlast a manoeuvre and show in its neighbours.
/// Source  Chernozhukov et al. 2018, "Double/debiased machine learning" (cross-fitting).
Misfit CrossFittedResidual(const ReplayBlock& block, const Likelihood& likelihood,
                           const Misfit& misfit, const std::vector<Manoeuvre>& manoeuvres);

/// CrossFittedResidual of one channel with `columns` in place of its flexible regressor, one row
/// per sample. Other channels are unchanged.
Misfit CrossFittedOver(const Eigen::MatrixXd& columns, std::size_t channel,
                       const Likelihood& likelihood, const Misfit& misfit,
                       const std::vector<Manoeuvre>& manoeuvres);

/// Noise of each channel on TRAIN and SELECT: the residual of a joint fit of the flexible regressor
/// and the found terms. The part of a missing mechanism that the flexible regressor can follow does
/// not count as noise; the rest does.
///
/// Model   ridge of 1e-6, because this fit need not predict. The scale is enlarged for the degrees
///         of freedom of the columns. Innovations are at least 0.2 % of the channel's RMS, because
///         no replay is better.
std::vector<NoiseModel> NoiseOfBlock(const ReplayBlock& block,
                                     const std::vector<Manoeuvre>& manoeuvres,
                                     const Structure& found = {});

}  // namespace tera
