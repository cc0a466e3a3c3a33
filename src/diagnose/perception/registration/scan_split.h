#pragma once

#include <cstddef>
#include <vector>

#include "core/random.h"
#include "core/time.h"
#include "diagnose/statistics/series/manoeuvres.h"

namespace tera {

/// Split of a recording's scans or pictures by blocks of time.
///
/// Model   blocks of a second, or of a fortieth of the recording if that is longer. Of each ten in
///         a row four are TRAIN, three SELECT and three FINAL, in random order.
/// Omits   pose noise that lasts longer than a block, which counts as error.
struct ScanSplit {
  std::vector<std::size_t> block;  ///< of each scan; empty blocks are not counted
  std::vector<Part> part;          ///< of each scan
  std::size_t blocks = 0;
};

/// `t_ns` of the scans, ascending.
ScanSplit SplitScans(const std::vector<TimeNs>& t_ns, const Stream& stream);

/// Fewest blocks with scans for judging a sensor: three of them are FINAL.
inline constexpr std::size_t kFewestBlocks = 10;

}  // namespace tera
