#pragma once

#include <cstddef>
#include <vector>

#include "diagnose/perception/scans/range_scan.h"

namespace tera {

/// Which of some points of a scan lie on the edge of a simulated object: a ray turned by 0.4 or 1.2
/// deg, in eight directions, meets one within 0.3 m of the measured range, or something whose shape
/// is unknown. Poses and encoders are not so exact that the edges of pictures agree.
std::vector<bool> OnEdges(const RangeSource& source, const SensorNumbers& numbers, std::size_t scan,
                          const std::vector<std::size_t>& points);

/// The points of a scan as rays.
std::vector<Beam> BeamsOf(const RangeScan& scan);

}  // namespace tera
