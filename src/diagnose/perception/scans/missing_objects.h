#pragma once

#include <string>
#include <vector>

#include "diagnose/perception/scans/scan_split.h"

namespace tera {

/// An object of the simulation through which the measured rays went.
struct MissingObject {
  int object = 0;
  std::size_t rays = 0;            ///< that should have met it
  double share = 0;                ///< of these that went on
  Vec2 centre_W_m = Vec2::Zero();  ///< of where they should have met it
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
  std::vector<std::vector<bool>> explained;  ///< of each scan, the points that went through one
};

MissingObjects FindMissingObjects(const RangeSource& source, const ScanSplit& split,
                                  const SensorNumbers& numbers);

}  // namespace tera
