#pragma once

#include <vector>

#include "diagnose/perception/scans/sensor_fit.h"

namespace tera {

/// Casts the rays of `points` under `numbers` and compares: how far each lies behind the simulated
/// surface.
///
/// Model   noise along the normal: that of the range times the cosine of incidence, an angle of
///         0.02 deg times the range (encoders and poses), and 2 mm of the surface.
/// Source  Chen and Medioni 1992 (distance to planes).
std::vector<PointResidual> ResidualsOf(const RangeSource& source,
                                       const std::vector<ScanPoints>& points,
                                       const SensorNumbers& numbers);

/// The same, to be searched. Keeps a reference.
SensorComparison ComparisonOf(const RangeSource& source);

}  // namespace tera
