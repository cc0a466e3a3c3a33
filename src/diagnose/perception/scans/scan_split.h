#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/random.h"
#include "diagnose/perception/scans/range_scan.h"
#include "diagnose/perception/scans/sensor_fit.h"
#include "diagnose/statistics/series/manoeuvres.h"

namespace tera {

/// Scans of a recording, shared out in blocks of time.
///
/// Model   blocks of a second, or of a fortieth of the recording where that is more; of each ten in
///         a row four are TRAIN, three SELECT and three FINAL, in random order. Noise of a pose
///         that lasts longer than a block passes for error.
struct ScanSplit {
  std::vector<std::size_t> block;  ///< of each scan
  std::vector<Part> part;          ///< of each scan
  std::size_t blocks = 0;          ///< those that have scans
};

ScanSplit SplitTimes(const std::vector<TimeNs>& t_ns, const Stream& stream);
ScanSplit SplitScans(const std::vector<RangeScan>& scans, const Stream& stream);

/// Fewest blocks with scans of which something may be said: three of them FINAL.
inline constexpr std::size_t kFewestBlocks = 10;

/// Up to `most` points of each scan, evenly spread, of scans of the given parts, without those that
/// `left_out` names (one list a scan, may be empty).
std::vector<ScanPoints> PointsOf(const std::vector<RangeScan>& scans, const ScanSplit& split,
                                 const std::vector<Part>& parts, std::size_t most,
                                 const std::vector<std::vector<bool>>& left_out);

}  // namespace tera
