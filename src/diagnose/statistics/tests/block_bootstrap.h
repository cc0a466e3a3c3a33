#pragma once

#include <cstddef>
#include <vector>

#include "core/random.h"
#include "diagnose/statistics/series/series.h"

namespace tera {

/// [0, size) in blocks of `length`. The last block is up to half longer or shorter.
std::vector<Segment> CutIntoBlocks(std::size_t size, std::size_t length);

/// Number of times that each of `blocks` blocks occurs in a bootstrap replicate: as many draws with
/// replacement as there are blocks.
///
/// Omits   dependence between blocks, which must be longer than the correlation.
/// Source  Künsch 1989, "The jackknife and the bootstrap for general stationary observations".
std::vector<int> DrawBlocks(std::size_t blocks, std::size_t replicate, const Stream& stream);

}  // namespace tera
