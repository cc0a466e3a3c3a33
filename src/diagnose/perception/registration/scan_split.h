#pragma once

#include <cstddef>
#include <vector>

#include "core/random.h"
#include "core/time.h"
#include "diagnose/statistics/series/manoeuvres.h"

namespace tera {

/// Scans or pictures of a recording, shared out in blocks of time.
///
/// Model   blocks of a second, or of a fortieth of the recording where that is more; of each ten in
///         a row four are TRAIN, three SELECT and three FINAL, in random order.
/// Omits   noise of a pose that lasts longer than a block, which passes for error.
struct ScanSplit {
  std::vector<std::size_t> block;  ///< of each scan, counted without blocks that have none
  std::vector<Part> part;          ///< of each scan
  std::size_t blocks = 0;
};

/// `t_ns` of the scans, ascending.
ScanSplit SplitScans(const std::vector<TimeNs>& t_ns, const Stream& stream);

/// Fewest blocks with scans by which a sensor is judged: three of them are FINAL.
inline constexpr std::size_t kFewestBlocks = 10;

}  // namespace tera
