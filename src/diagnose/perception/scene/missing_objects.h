#pragma once

#include <string>
#include <vector>

#include "diagnose/perception/registration/registration_block.h"
#include "diagnose/perception/scans/range_source.h"

namespace tera {

/// A simulated object that the measured rays pass through.
struct MissingObject : SceneDifference {
  int object = 0;
  /// Number of rays that hit it in the simulation, without those stopped in front of it.
  std::size_t rays = 0;
  double share = 0;  ///< share of these rays that pass through
};

/// Finds obstacles of the simulation that are missing in the recording.
///
/// Model   A ray passes through an obstacle if its measured point lies at least 0.3 m behind the
///         simulated hit, along the ray. The point must also be at least 0.15 m from the obstacle's
///         surface. Rays that end equally far in front of the obstacle are ignored, because
///         something else stopped them.
///         An obstacle with at least 20 rays is missing if more than half of them pass. TRAIN and
///         SELECT together must show this, and FINAL must show it again. The test is Student's t
///         over at least three blocks of time, at one per cent over the obstacles. The standard
///         deviation of the mean is at least 0.03.
/// Omits   Rays without a return, because scans contain no points for them.
struct MissingObjects {
  std::vector<MissingObject> objects;
  PointFlags explained;  ///< points measured behind a missing object
};

MissingObjects FindMissingObjects(const RangeSource& source, const ScanSplit& split,
                                  const SensorCalibration& calibration);

}  // namespace tera
