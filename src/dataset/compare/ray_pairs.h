#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "core/types/measurement.h"

namespace tera {

/// First returns of two scans by ray, as indices into their points.
struct RayPairs {
  std::vector<std::pair<std::size_t, std::size_t>> both;  ///< a return in a and one in b
  std::vector<std::size_t> only_a, only_b;                ///< no return in the other
};

/// Indices of the first returns of a scan's rays. Points in sequence of one time and ring are of
/// one ray; where a scan has no times or no rings, those of one direction.
std::vector<std::size_t> FirstReturns(const LidarScan& scan);

/// Pairs the rays of two scans by direction.
///
/// Frames  the sensor's of each scan; the scans have one place and one attitude.
/// Model   a ray of `a` has a return in `b` if a return of `b` left within three quarters of the
///         spacing of rays: the median angle between a ray and its next one, of the coarser scan.
///         With beams that both scans number alike (from the top down or from the bottom up), a ray
///         is paired within its beam, by azimuth alone. Else it is paired by its direction from the
///         sensor's origin.
/// Omits   beams without numbers that leave beside the origin: 4 cm are half a degree at 5 m.
RayPairs PairRays(const LidarScan& a, const LidarScan& b);

}  // namespace tera
