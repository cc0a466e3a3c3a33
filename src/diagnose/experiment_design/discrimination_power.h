#pragma once

#include "core/random.h"
#include "diagnose/experiment_design/ambiguity_set.h"
#include "diagnose/search/fit/replay_block.h"
#include "diagnose/statistics/series/noise_model.h"

namespace tera {

/// Probability that a diagnosis of a run would say which explanation of a set holds: the smallest
/// over the set's pairs. 0 where the run has too few manoeuvres to be diagnosed.
///
/// Model   the true explanation's prediction stands for the measurements; the alternative is fitted
///         to them over TRAIN and SELECT. The tests of rivals (structure_search.h) for a class, or
///         those of a mechanism against nothing at `level` (block_diagnosis.h), are asked under 100
///         draws of the noise. A draw's gain in log-likelihood is normal: its mean is the possible
///         gain, its variance twice that.
/// Omits   that noise is estimated anew in the diagnosis.
double DiscriminationPower(const AmbiguitySet& set, const ReplayBlock& run, const NoiseModel& noise,
                           double level, const Stream& stream);

}  // namespace tera
