#pragma once

#include <string>
#include <vector>

#include "diagnose/perception/registration/registration_block.h"
#include "diagnose/perception/scans/range_source.h"

namespace tera {

/// A simulated object that measured rays pass through.
struct MissingObject : SceneDifference {
  int object = 0;
  std::size_t rays = 0;  ///< rays that hit it in the simulation
  double share = 0;      ///< share of these that passed
};

/// Obstacles of the simulation that the recording does not show at their places.
///
/// Model   a measured point is behind its ray's simulated obstacle if it is at least 0.3 m further
///         along the ray, and in front if 0.3 m nearer. Either way it must be at least 0.15 m from
///         the obstacle's surface.
///         Among rays without a return in front, those with a point behind passed through. An
///         obstacle is missing if more than half of at least 20 rays passed, in TRAIN and SELECT
///         and again in FINAL. The test is Student's t over at least three blocks of time, at one
///         per cent over the obstacles. The standard deviation of the mean is at least 0.03.
/// Omits   rays without any return, since a scan has no point of them.
struct MissingObjects {
  std::vector<MissingObject> objects;
  PointFlags explained;  ///< points that were measured behind one
};

MissingObjects FindMissingObjects(const RangeSource& source, const ScanSplit& split,
                                  const SensorCalibration& calibration);

}  // namespace tera
