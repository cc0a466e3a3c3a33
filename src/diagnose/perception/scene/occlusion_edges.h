#pragma once

#include <cstddef>
#include <vector>

#include "diagnose/perception/scans/range_source.h"

namespace tera {

/// Finds the points of a scan at which a simulated object begins to occlude its background. A ray
/// turned by 0.4 or 1.2 deg, in eight directions, meets an object within 0.3 m of the measured
/// range, or one of unknown shape. Poses and encoders are too inexact for comparing such points.
std::vector<bool> OnOcclusionEdges(const RangeSource& source, const SensorCalibration& calibration,
                                   std::size_t scan, const std::vector<std::size_t>& points);

}  // namespace tera
