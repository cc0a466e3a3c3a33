#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "core/types/measurement.h"

namespace tera {

/// Rays of two scans, matched. Indices refer to the first returns in the scans' points.
struct RayPairs {
  std::vector<std::pair<std::size_t, std::size_t>> both;  ///< a return in both scans
  std::vector<std::size_t> only_a, only_b;                ///< a return in one scan only
};

/// Indices of the first return of each ray of a scan. Consecutive points with equal time and ring
/// belong to one ray. If a scan has no times or no rings, consecutive points with equal direction
/// do.
std::vector<std::size_t> FirstReturns(const LidarScan& scan);

/// Matches the rays of two scans by direction.
///
/// Frames  The sensor frame of each scan. The sensors must have equal position and attitude.
/// Model   A ray of `a` matches a ray of `b` if the angle between them is at most three quarters of
///         the ray spacing. The spacing is the median angle between neighbouring rays of the
///         coarser scan. If both scans number their beams in the same order, top to bottom or
///         bottom to top, a ray is matched within its beam, by azimuth. Otherwise it is matched by
///         its direction from the sensor origin.
/// Omits   the offset of beam origins if beams are not numbered: 4 cm are half a degree at 5 m.
RayPairs PairRays(const LidarScan& a, const LidarScan& b);

}  // namespace tera
