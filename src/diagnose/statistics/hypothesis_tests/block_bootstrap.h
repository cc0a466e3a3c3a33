#pragma once

#include <cstddef>
#include <vector>

#include "core/random.h"
#include "diagnose/statistics/series/series.h"

namespace tera {

/// [0, size) cut into blocks of `length`; the last one is up to half longer or shorter.
std::vector<Segment> CutIntoBlocks(std::size_t size, std::size_t length);

/// Counts of each of `blocks` blocks in a bootstrap replicate, drawn with replacement, as many
/// draws as blocks.
///
/// Omits   dependence between blocks: they must be longer than the correlation.
/// Source  Künsch 1989, "The jackknife and the bootstrap for general stationary observations".
std::vector<int> DrawBlocks(std::size_t blocks, std::size_t replicate, const Stream& stream);

}  // namespace tera
