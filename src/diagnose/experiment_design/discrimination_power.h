#pragma once

#include "core/random.h"
#include "diagnose/experiment_design/ambiguity_set.h"
#include "diagnose/search/fit/replay_block.h"
#include "diagnose/statistics/series/noise_model.h"

namespace tera {

/// Probability that a diagnosis of a run identifies the true hypothesis of a set: the minimum over
/// the set's pairs. 0 if the run has too few manoeuvres for a diagnosis.
///
/// Model   the true hypothesis's prediction replaces the measurements, and the alternative is
///         fitted to it over TRAIN and SELECT. The tests are those of rivals (structure_search.h)
///         for a class, or those of a mechanism against nothing at `level` (block_diagnosis.h),
///         under 100 draws of the noise. A draw's gain in log-likelihood is normal: its mean is the
///         possible gain, its variance twice that.
/// Omits   the diagnosis's own estimate of the noise.
double DiscriminationPower(const AmbiguitySet& set, const ReplayBlock& run, const NoiseModel& noise,
                           double level, const Stream& stream);

}  // namespace tera
