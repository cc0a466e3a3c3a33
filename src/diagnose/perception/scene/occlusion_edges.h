#pragma once

#include <cstddef>
#include <vector>

#include "diagnose/perception/scans/range_source.h"

namespace tera {

/// Which of some points of a scan lie where a simulated object begins to occlude what is behind it:
/// a ray turned by 0.4 or 1.2 deg, in eight directions, meets one within 0.3 m of the measured
/// range, or something whose shape is unknown. Poses and encoders are not exact enough for such
/// points to be compared.
std::vector<bool> OnOcclusionEdges(const RangeSource& source, const SensorCalibration& calibration,
                                   std::size_t scan, const std::vector<std::size_t>& points);

}  // namespace tera
