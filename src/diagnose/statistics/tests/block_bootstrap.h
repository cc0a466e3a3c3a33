#pragma once

#include <cstddef>
#include <vector>

#include "core/random.h"
#include "diagnose/statistics/series/series.h"
#include "diagnose/statistics/tests/proportion.h"

namespace tera {

/// [0, size) cut into blocks of `length`; the last one is up to half longer or shorter.
std::vector<Segment> CutIntoBlocks(std::size_t size, std::size_t length);

/// The number of times each of `blocks` blocks is drawn in a replicate: with replacement, as many
/// draws as blocks.
std::vector<int> DrawBlocks(std::size_t blocks, std::size_t replicate, const Stream& stream);

/// Percentile interval of sum(numerator) / sum(denominator) under resampling of blocks.
///
/// Omits   dependence between blocks: they must be longer than the correlation.
/// Source  Künsch 1989, "The jackknife and the bootstrap for general stationary observations".
Interval BootstrapRatio(const std::vector<double>& numerator,
                        const std::vector<double>& denominator, double confidence,
                        std::size_t replicates, const Stream& stream);

}  // namespace tera
