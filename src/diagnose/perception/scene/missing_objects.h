#pragma once

#include <string>
#include <vector>

#include "diagnose/perception/registration/scan_split.h"
#include "diagnose/perception/scans/range_source.h"

namespace tera {

/// An object of the simulation behind which the measured rays went on.
struct MissingObject {
  int object = 0;
  std::size_t rays = 0;            ///< that meet it in the simulation
  double share = 0;                ///< of these that went on
  Vec2 centre_W_m = Vec2::Zero();  ///< of where they meet it
  double p_chosen = 1, p_confirmed = 1;
  double rmse_before_m = 0;  ///< of the distances behind it, on FINAL
};

/// Obstacles of the simulation that the recording does not show where they should be.
///
/// Model   a ray that meets an obstacle in the simulation was measured behind it, or before it,
///         where it ended 0.3 m and more further, or nearer, along the ray, and 0.15 m and more
///         off the obstacle's surface. Of those that did not end before it the ones behind it went
///         on. An obstacle is missing where more than half did, of 20 at least, in TRAIN and SELECT
///         and again in FINAL, by Student's t over three blocks of time at least, whose mean is
///         known to 0.03 at best, at one per cent over the obstacles.
/// Omits   rays that met nothing at all, of which a scan holds no point.
struct MissingObjects {
  std::vector<MissingObject> objects;
  PointFlags explained;  ///< points that were measured behind one
};

MissingObjects FindMissingObjects(const RangeSource& source, const ScanSplit& split,
                                  const SensorCalibration& calibration);

}  // namespace tera
