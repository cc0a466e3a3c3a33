#pragma once

#include <vector>

#include "diagnose/perception/registration/registration_search.h"
#include "diagnose/perception/scans/range_source.h"

namespace tera {

/// Casts the rays of `points` under a calibration. The residual is each point's distance behind the
/// simulated surface on its ray.
///
/// Model   noise along the normal: that of the range times the cosine of incidence, an angle of
///         0.02 deg times the range (encoders and poses), and 2 mm of the surface.
/// Source  Chen and Medioni 1992 (distance to planes).
std::vector<PointResidual> ResidualsOf(const RangeSource& source,
                                       const std::vector<ScanPoints>& points,
                                       const SensorCalibration& calibration);

/// The scans with their sensor's candidate effects. Keeps a reference.
RegistrationBlock BlockOf(const RangeSource& source);

/// Up to `most` points of each scan of the given parts, evenly spread, without the `excluded` ones.
std::vector<ScanPoints> PointsOf(const std::vector<RangeScan>& scans, const ScanSplit& split,
                                 const std::vector<Part>& parts, std::size_t most,
                                 const PointFlags& excluded);

/// Up to 400 points of each scan for registration, without the `excluded` ones, which a finding in
/// the scene explains.
SplitPoints PointsToRegister(const RangeSource& source, const ScanSplit& split,
                             const PointFlags& excluded);

}  // namespace tera
